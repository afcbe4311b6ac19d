"""A program killed (-9) at any moment of a save leaves the old content or the new one, and nothing in between."""

from __future__ import annotations

import contextlib
import io
import os
import random
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from itertools import count, cycle
from pathlib import Path

import numpy as np
import pytest
from bot_console.tui.cli.verbs.export import run as export_package
from bot_console.tui.commanding.history import LineHistory
from bot_console.tui.console.bags.reader import Bag
from bot_console.tui.console.bags.writer import BagWriter
from bot_console.tui.console.model import Change, ChangeSource, Kind, ParameterInfo, ParameterTree
from bot_console.tui.console.parameters.file.saving import save
from bot_console.tui.files.save_file import SUFFIX, save_file
from bot_console.tui.layout.tree import beside
from bot_console.tui.panes.graph.export import export_graph
from bot_console.tui.panes.history.export import export
from bot_console.tui.panes.plot.curves import Curve
from bot_console.tui.panes.plot.save import picture, samples
from bot_console.tui.panes.plot.view import Axes
from bot_console.tui.settings.layouts import FileLayouts
from bot_console.tui.settings.state_files import StateFiles
from bot_console.tui.widgets.diagram.drawing import draw
from bot_console.tui.widgets.diagram.graph import Digraph, Item
from rclpy.serialization import deserialize_message, serialize_message
from std_msgs.msg import String

PROGRAM = """import sys, runpy
from bot_console.runtime.importer import install
install()
sys.argv.pop(0)
runpy.run_path(sys.argv[0], run_name="__main__")
"""
LINES = 2000
COMMENT = "# mine\n"
PANES = ("logs", "graph", "plot")
NO_DRAWING = draw(Digraph((), ()))


def log(folder: Path, number: int) -> None:
    save_file(folder / "log.txt", f"{number}\n" * LINES)


def parameters(folder: Path, number: int) -> None:
    values = (ParameterInfo("/n", name, Kind.INTEGER, number) for name in ("a", "b", "c"))
    save(folder / "parameters.yaml", {"/n": ParameterTree("/n", tuple(values))})


def plot(folder: Path, number: int) -> None:
    curve = Curve("/speed", times=np.arange(200.0), values=np.full(200, float(number)))
    samples(folder / "plot.csv", [curve], Axes(0.0, 200.0), float)
    picture(folder / "plot.txt", [curve], [], Axes(0.0, 200.0), float)


def graph(folder: Path, number: int) -> None:
    shown = Digraph(tuple(Item(f"/n{at}", f"node {number}") for at in range(200)), ())
    save_file(folder / "graph.mmd", export_graph(shown, NO_DRAWING, ".mmd"))


def history(folder: Path, number: int) -> None:
    changes = [Change(seq, 0, "/n", "p", number, number, ChangeSource.EDIT) for seq in range(50)]
    export(folder / "history.csv", changes)


def settings(folder: Path, number: int) -> None:
    FileLayouts(PANES).save("mine", beside(PANES[number % 2], "plot"))
    StateFiles().put("alarms", [number] * 200)
    LineHistory().add(f"set /n p {number}")


def package(folder: Path, number: int) -> None:
    """Export beside the remains of killed exports, without a question: each process has a separate name."""
    with contextlib.redirect_stdout(io.StringIO()):
        export_package([str(folder / "packages" / f"{os.getpid()}-{number}")])


def bag(folder: Path, number: int) -> None:
    writer = BagWriter(folder / "bags" / f"{os.getpid()}-{number}")
    writer.topic("/words", String, [])
    for at in range(50):
        writer.write("/words", serialize_message(String(data=str(at))), at + 1, 0)
        writer.flush()
    writer.close()


WRITERS = {log: 0.05, parameters: 0.05, plot: 0.1, graph: 0.05, history: 0.05, settings: 0.1, package: 0.5, bag: 0.1}
"""Every file that the program saves, with a different number in each line, and within how many seconds it is killed."""


def write_for_ever(writer: Callable[[Path, int], None], folder: Path) -> None:
    for number in count():
        writer(folder, number)


def assert_whole(folder: Path) -> None:
    """Check that the files are as some save has left them, and that nothing partial could be taken for one."""
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
    labels = [each.partition("[")[2] for each in (folder / "graph.mmd").read_text().splitlines()[1:]]
    assert len(labels) == 200 and len(set(labels)) == 1
    alarms = StateFiles().get("alarms")
    assert isinstance(alarms, list) and len(alarms) == 200 and len(set(alarms)) == 1
    assert LineHistory().file.read_text().endswith("\n")
    for each in (folder / "bags").iterdir():
        if any(file.stat().st_size for file in each.glob("*.mcap")):  # Otherwise it had not started.
            texts = [deserialize_message(entry.data, String).data for entry in Bag(each).messages()]
            assert texts == [str(at) for at in range(len(texts))]
        shutil.rmtree(each)
    for each in (folder / "packages").iterdir():
        assert_same_files(each, folder / "package")
        shutil.rmtree(each)


def assert_same_files(part: Path, whole: Path) -> None:
    """Check that every file of an export is complete."""
    for each in part.rglob("*"):
        if each.is_file() and not each.name.endswith(SUFFIX):
            assert each.read_bytes() == (whole / each.relative_to(part)).read_bytes(), each


def kill_writers(folder: Path, times: int) -> None:
    """Start writers one by one and kill each at a random moment; the random numbers are the same each time."""
    moments = random.Random(times)
    (folder / "parameters.yaml").write_text(COMMENT + "/n:\n  ros__parameters:\n    a: 0\n    b: 0\n    c: 0\n")
    for writer in WRITERS:  # This imports what they need, before the first fork.
        writer(folder, 0)
    (folder / "packages" / f"{os.getpid()}-0").rename(folder / "package")
    for _, (writer, longest) in zip(range(times), cycle(WRITERS.items()), strict=False):
        child = os.fork()
        if child == 0:
            write_for_ever(writer, folder)
        time.sleep(moments.uniform(0.0, longest))
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        assert_whole(folder)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork")
@pytest.mark.parametrize(
    "times",
    [
        pytest.param(10, marks=pytest.mark.slow),
        pytest.param(1000, marks=[pytest.mark.soak, pytest.mark.timeout(1000)]),
    ],
)
def test_kill_at_random_moments_leaves_complete_files(times: int, tmp_path: Path) -> None:
    # In a separate interpreter: a fork is safe only if no other thread runs.
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, __file__, str(tmp_path), str(times)], check=False, timeout=900,
        capture_output=True, text=True,
        env={**os.environ, "XDG_CONFIG_HOME": str(tmp_path / "config"), "XDG_STATE_HOME": str(tmp_path / "state"),
             "TMPDIR": str(tmp_path)},
    )  # fmt: skip
    assert done.returncode == 0, done.stderr


if __name__ == "__main__":
    kill_writers(Path(sys.argv[1]), int(sys.argv[2]))
