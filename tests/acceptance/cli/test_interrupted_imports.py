"""Ctrl-C while a command is still importing its modules ends it silently by the signal, like any other program."""

from __future__ import annotations

import ast
import signal
import subprocess
import sys
from pathlib import Path

import pytest

STARTS = {
    "command": "from bot_console.tui.cli.entry import program; program()",
    "module": "import runpy; runpy.run_module('bot_console.tui', run_name='__main__', alter_sys=True)",
}
INTERRUPTED = """
import importlib.abc, signal, sys

class Interrupt(importlib.abc.MetaPathFinder):
    def find_spec(self, name, path, target=None):
        if name == {name!r}:
            signal.raise_signal(signal.SIGINT)

sys.meta_path.insert(0, Interrupt())
{start}
"""
TIMEOUT_S = 240.0


def interrupted(name: str, start: str, folder: Path, *words: str) -> subprocess.CompletedProcess[str]:
    """Run a command that gets a SIGINT when it begins to import a module."""
    code = INTERRUPTED.format(name=f"bot_console.{name}", start=STARTS[start])
    return subprocess.run(
        [sys.executable, "-c", code, *words], cwd=folder, capture_output=True, text=True, timeout=TIMEOUT_S, check=False
    )


@pytest.mark.parametrize("start", STARTS)
@pytest.mark.parametrize("name", ["tui.cli.main", "runtime.rmw.zenoh.domain.folder"])
def test_interrupted_import_of_the_command_line_ends_silently_by_the_signal(
    name: str, start: str, tmp_path: Path
) -> None:
    done = interrupted(name, start, tmp_path, "topic", "list")
    assert (done.returncode, done.stdout, done.stderr) == (-signal.SIGINT, "", "")


def test_interrupted_import_of_a_command_ends_silently_with_the_code_of_ctrl_c(tmp_path: Path) -> None:
    done = interrupted("tui.cli.doctor", "command", tmp_path, "doctor")
    assert (done.returncode, done.stdout, done.stderr) == (128 + signal.SIGINT, "", "")


def test_entry_point_imports_nothing_before_it_expects_an_interrupt(tmp_path: Path) -> None:
    code = "import sys; before = set(sys.modules); import bot_console.tui.cli.entry; print(set(sys.modules) - before)"
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, timeout=TIMEOUT_S, check=True
    )
    imported = {each for each in ast.literal_eval(done.stdout) if not each.startswith("bot_console")}
    assert imported <= {"_signal"}


def test_ignored_interrupt_stays_ignored_during_imports(tmp_path: Path) -> None:
    ignoring = "import signal; signal.signal(signal.SIGINT, signal.SIG_IGN); "
    code = ignoring + INTERRUPTED.format(name="bot_console.tui.cli.main", start=STARTS["command"])
    done = subprocess.run(
        [sys.executable, "-c", code, "--version"], cwd=tmp_path, capture_output=True, text=True, timeout=TIMEOUT_S,
        check=False,
    )  # fmt: skip
    assert (done.returncode, done.stderr) == (0, "")
