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

import numpy as np
import pytest
from bot_console.tui.console.model import Change, ChangeSource, Kind, ParameterInfo, ParameterTree
from bot_console.tui.console.parameters.file.saving import save
from bot_console.tui.files.save_file import save_file
from bot_console.tui.layout.tree import beside
from bot_console.tui.panes.history.export import export
from bot_console.tui.panes.plot.curves import Curve
from bot_console.tui.panes.plot.save import picture, samples
from bot_console.tui.panes.plot.view import Axes
from bot_console.tui.settings.layouts import FileLayouts

LINES = 2000
COMMENT = "# mine\n"
PANES = ("logs", "graph", "plot")


def write_for_ever(folder: Path) -> None:
    """Save everything that the program saves again and again, each time with another number in every line."""
    for number in count():
        write(folder, number)


def write(folder: Path, number: int) -> None:
    """One round of all writers: a log, parameters, samples and picture of a plot, history, layouts, settings."""
    save_file(folder / "log.txt", f"{number}\n" * LINES)
    values = (ParameterInfo("/n", name, Kind.INTEGER, number) for name in ("a", "b", "c"))
    save(folder / "parameters.yaml", {"/n": ParameterTree("/n", tuple(values))})
    curve = Curve("/speed", times=np.arange(200.0), values=np.full(200, float(number)))
    samples(folder / "plot.csv", [curve], Axes(0.0, 200.0), float)
    picture(folder / "plot.txt", [curve], [], Axes(0.0, 200.0), float)
    changes = [Change(seq, 0, "/n", "p", number, number, ChangeSource.EDIT) for seq in range(50)]
    export(folder / "history.csv", changes)
    FileLayouts(PANES).save("mine", beside(PANES[number % 2], "plot"))


def assert_whole(folder: Path) -> None:
    """The files are as some save has left them, and nothing half-written will be taken for one."""
    lines = (folder / "log.txt").read_text().splitlines()
    assert len(lines) == LINES and len(set(lines)) == 1
    comment, *rest = (folder / "parameters.yaml").read_text().splitlines()
    assert comment + "\n" == COMMENT and len(rest) == 5
    assert len({each.partition(": ")[2] for each in rest[2:]}) == 1
    rows = (folder / "plot.csv").read_text().splitlines()
    assert len(rows) == 201 and len({each.rpartition(",")[2] for each in rows[1:]}) == 1
    assert (folder / "plot.txt").read_text().count("\n") >= 30
    rows = (folder / "history.csv").read_text().splitlines()
    assert len(rows) == 51 and len({each.split(",")[4] for each in rows[1:]}) == 1
    assert FileLayouts(PANES).layouts()["mine"]


def kill_writers(folder: Path, times: int) -> None:
    """Start writers one by one and kill each at a random moment; the random numbers are the same each time."""
    moments = random.Random(times)
    (folder / "parameters.yaml").write_text(COMMENT + "/n:\n  ros__parameters:\n    a: 0\n    b: 0\n    c: 0\n")
    write(folder, 0)
    for _ in range(times):
        child = os.fork()
        if child == 0:
            write_for_ever(folder)
        time.sleep(moments.uniform(0.0, 0.1))
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        assert_whole(folder)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="forks")
@pytest.mark.parametrize("times", [10, pytest.param(1000, marks=[pytest.mark.soak, pytest.mark.timeout(1000)])])
def test_killed_at_random_moments(times: int, tmp_path: Path) -> None:
    # In an interpreter of its own: a fork is safe only where no thread runs.
    done = subprocess.run(
        [sys.executable, __file__, str(tmp_path), str(times)], check=False, timeout=900, capture_output=True, text=True,
        env={**os.environ, "XDG_CONFIG_HOME": str(tmp_path / "config"), "XDG_STATE_HOME": str(tmp_path / "state")},
    )  # fmt: skip
    assert done.returncode == 0, done.stderr


if __name__ == "__main__":
    kill_writers(Path(sys.argv[1]), int(sys.argv[2]))
