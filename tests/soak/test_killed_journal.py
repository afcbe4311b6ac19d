"""A program killed (-9) while it records changes loses none that it showed, and the next program reads them all."""

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
from bot_console.tui.console.model import ChangeSource
from bot_console.tui.console.parameters.history_file import MAX_ROWS, History
from bot_console.tui.console.parameters.journal import Journal

NUMBER = 8
"""Bytes of a number in the pipe."""


def note_for_ever(file: Path, first: int, noted: int) -> None:
    """Record changes with consecutive numbers, and write each number to the pipe `noted` once the change is visible."""
    journal = Journal(history=History(file, time.time_ns()))
    for number in count(first):
        journal.record(time.time_ns(), "/n", "p", (number - 1, number), ChangeSource.EDIT)
        os.write(noted, number.to_bytes(NUMBER, "little"))


def numbers(file: Path) -> list[int]:
    """The numbers that another program reads."""
    history = History(file, time.time_ns())
    found = [each.new for each in history.earlier(MAX_ROWS)]
    assert not history.problem, history.problem
    history.close()
    return [each for each in found if isinstance(each, int)]


def kill_writers(file: Path, times: int) -> None:
    """Start writers one by one and kill each at a random moment; the random numbers are the same each time."""
    moments = random.Random(times)
    last = 0
    for _ in range(times):
        reported, noted = os.pipe()
        child = os.fork()
        if child == 0:
            note_for_ever(file, last + 1, noted)
        os.close(noted)
        time.sleep(moments.uniform(0.0, 0.1))
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        with os.fdopen(reported, "rb") as pipe:
            seen = pipe.read()
        newest = int.from_bytes(seen[-NUMBER:], "little") if seen else last
        there = numbers(file)
        last = there[-1] if there else 0
        # There may be one more than was shown: it was on disk, and the program died before it showed it.
        assert last in (newest, newest + 1)
        assert there == list(range(last - len(there) + 1, last + 1)), "none in between is missing"
    assert last > times


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork")
@pytest.mark.parametrize(
    "times",
    [
        3,
        pytest.param(10, marks=pytest.mark.slow),
        pytest.param(1000, marks=[pytest.mark.soak, pytest.mark.timeout(1000)]),
    ],
)
def test_no_change_that_was_shown_is_lost(times: int, tmp_path: Path) -> None:
    # In a separate interpreter: a fork is safe only if no other thread runs.
    done = subprocess.run(
        [sys.executable, __file__, str(tmp_path / "history.sqlite"), str(times)],
        check=False,
        timeout=900,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr


if __name__ == "__main__":
    kill_writers(Path(sys.argv[1]), int(sys.argv[2]))
