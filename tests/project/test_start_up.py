"""The import budget of each start: what must not be imported before the first thing that a person waits for.

Imports within functions exist for this budget, for names that exist only once the runtime is installed, and for
packages that may be missing. All others belong at the top of their file.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

import pytest

REPORT = """
import json, os, sys

def report(before=()):
    os.write(1, b"\\n" + json.dumps(sorted(set(sys.modules).difference(before))).encode())
    os._exit(0)
"""
VERSION = """
import __future__, collections.abc, re, typing  # what the script that pip writes brings along, at most
import contextlib  # which `typing` brings along before Python 3.13
import errno, signal  # part of Python itself
before = set(sys.modules)
from bot_console.tui.cli.main import main
assert main(["--version"]) == 0
report(before)
"""
FIRST_FRAME = """
import asyncio
from bot_console.tui.cli import open_console
from bot_console.tui.cli.arguments import parse
from bot_console.tui.session.live import Session

Session._reach = lambda session: report()

async def show():
    async with Session(parse([])).app.run_test(size=(120, 40)):
        await asyncio.Event().wait()

asyncio.run(show())
"""
VERB = """
from bot_console.tui.cli.main import main
main(["topic", "list"])
report()
"""
NODE = """
import rclpy
from std_msgs.msg import String

rclpy.init()
rclpy.create_node("lean").create_publisher(String, "out", 1)
report()
"""
SCREEN = {"textual", "rich", "plotext", "bot_console.tui.app", "bot_console.tui.panes"}
DATA = {"numpy", "yaml", "sqlite3", "mcap", "PIL", "cv2", "pymunk", "re2"}
LIBRARY = {"http", "email", "unittest", "multiprocessing", "importlib.metadata", "urllib.request", "pydoc", "ctypes"}
LAUNCH = {"launch", "launch_ros"}
BUDGETS = {
    "first frame": (
        FIRST_FRAME,
        {"numpy", "yaml", "sqlite3", "mcap", "PIL", "cv2", "pymunk", "plotext", "rclpy", "zenoh", "xml.etree"}
        | {"bot_console.tui.console.node", "bot_console.runtime.rmw", "bot_console.runtime.importer"}
        | LIBRARY
        | LAUNCH,
    ),
    "verb": (VERB, SCREEN | DATA | LIBRARY | LAUNCH | {"asyncio", "ssl", "subprocess", "difflib", "xml.etree"}),
    "node": (
        NODE,
        SCREEN | DATA | LIBRARY | LAUNCH | {"asyncio", "ssl", "subprocess", "argparse", "zenoh", "bot_console.tui"},
    ),
}
"""The program of each start, and the modules that it must not import."""


def imported(folder: Path, program: str, *words: str) -> tuple[str, list[str]]:
    """The output of a program, and the modules that it has imported when it reports them."""
    file = folder / "started.py"
    file.write_text(REPORT + program, encoding="utf-8")
    environment = {**os.environ, "BOT_CONSOLE_USER_DIR": str(folder / "user")}
    command = [sys.executable, *words, str(file)]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.stdout, done.stderr
    *printed, modules = done.stdout.splitlines()
    return "\n".join(printed).strip(), json.loads(modules)


def test_version_is_printed_without_imports(tmp_path: Path) -> None:
    printed, modules = imported(tmp_path, VERSION)
    assert printed == f"bot-console {version('bot-console')}"
    assert [each for each in modules if not each.startswith("bot_console")] == []


@pytest.mark.parametrize("start", BUDGETS)
def test_start_imports_nothing_beyond_its_budget(start: str, tmp_path: Path) -> None:
    program, unwanted = BUDGETS[start]
    words = ("-m", "bot_console.runtime.programs.run") if start == "node" else ()
    modules = imported(tmp_path, program, *words)[1]
    assert len(modules) > 100, "the program has reported its modules"
    assert unwanted.intersection(modules) == set()
