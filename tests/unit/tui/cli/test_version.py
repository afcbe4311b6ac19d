"""`bot-console --version`: the package's version, at the cost of starting Python."""

from __future__ import annotations

import json
import subprocess
import sys
from importlib.metadata import version

PROGRAM = """
import json, sys
import __future__, collections.abc, re, typing  # what the script that pip writes brings along, at most
before = set(sys.modules)
from bot_console.tui.cli.main import main
code = main(["--version"])
print(json.dumps([code, sorted(each for each in set(sys.modules) - before if not each.startswith("bot_console"))]))
"""


def test_version_is_printed_without_heavy_imports() -> None:
    reported = subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, text=True, check=True).stdout
    line, modules = reported.splitlines()
    assert line == f"bot-console {version('bot-console')}"
    assert json.loads(modules) == [0, []]
