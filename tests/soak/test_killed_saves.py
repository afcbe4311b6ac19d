"""A program killed (-9) at any moment of a save leaves the old content or the new one, and nothing in between."""

from __future__ import annotations

import os
import random
import signal
import subprocess
import sys
import time
from itertools import count
from pathlib import Path

import pytest
from bot_console.tui.console.model import Kind, ParameterInfo, ParameterTree
from bot_console.tui.console.parameters.file import save
from bot_console.tui.save_file import save_file

LINES = 2000
COMMENT = "# mine\n"


def write_for_ever(folder: Path) -> None:
    """Save a log and a parameter file again and again, each time with another number in every line."""
    for number in count():
        save_file(folder / "log.txt", f"{number}\n" * LINES)
        values = (ParameterInfo("/n", name, Kind.INTEGER, number) for name in ("a", "b", "c"))
        save(folder / "parameters.yaml", {"/n": ParameterTree("/n", tuple(values))})


def assert_whole(folder: Path) -> None:
    """The files are as some save has left them."""
    lines = (folder / "log.txt").read_text().splitlines()
    assert len(lines) == LINES and len(set(lines)) == 1
    comment, *rest = (folder / "parameters.yaml").read_text().splitlines()
    assert comment + "\n" == COMMENT and len(rest) == 5
    assert len({each.partition(": ")[2] for each in rest[2:]}) == 1


def kill_writers(folder: Path, times: int) -> None:
    """Start writers one by one and kill each at a random moment; the random numbers are the same each time."""
    moments = random.Random(times)
    save_file(folder / "log.txt", "old\n" * LINES)
    save_file(folder / "parameters.yaml", COMMENT + "/n:\n  ros__parameters:\n    a: 0\n    b: 0\n    c: 0\n")
    for _ in range(times):
        child = os.fork()
        if child == 0:
            write_for_ever(folder)
        time.sleep(moments.uniform(0.0, 0.02))
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        assert_whole(folder)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="forks")
@pytest.mark.parametrize("times", [20, pytest.param(1000, marks=pytest.mark.soak)])
def test_killed_at_random_moments(times: int, tmp_path: Path) -> None:
    # In an interpreter of its own: a fork is safe only where no thread runs.
    done = subprocess.run(
        [sys.executable, __file__, str(tmp_path), str(times)], check=False, timeout=600, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    assert_whole(tmp_path)


if __name__ == "__main__":
    kill_writers(Path(sys.argv[1]), int(sys.argv[2]))
