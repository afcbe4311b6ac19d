"""A limit of open files that is too low for a console is raised, or reported."""

from __future__ import annotations

import subprocess
import sys

import pytest

if sys.platform == "win32":
    pytest.skip("there is no such limit", allow_module_level=True)

PROGRAM = """
import resource
resource.setrlimit(resource.RLIMIT_NOFILE, ({soft}, {hard}))
from bot_console.tui.cli.screen import too_few_files
print(too_few_files())
print(resource.getrlimit(resource.RLIMIT_NOFILE)[0])
"""


@pytest.mark.parametrize(
    ("soft", "hard", "message", "now"),
    [
        (300, 300, "", "300"),
        (64, 300, "", "256"),
        (64, 200, "bot-console needs 256 open files, and at most 200 are allowed here: see `ulimit -Hn`", "64"),
    ],
)
def test_low_limit_is_raised_or_reported(soft: int, hard: int, message: str, now: str) -> None:
    program = PROGRAM.format(soft=soft, hard=hard)
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=120, check=True)
    assert done.stdout.split("\n")[:2] == [message, now]
