"""Every command recorded on real ROS 2 gives the same output and exit code here, run on the same system."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import ExitStack
from pathlib import Path

import pytest
from helpers.recorded.cases import faults
from helpers.recorded.commands import COURSE, Row, filled, normal, rows, usage_of_other_interpreter
from systems import Program, System, system

SETTLE = 1.0
"""Seconds that the programs of a system run before the first command."""

Words = Sequence[str]


class Systems:
    """Keeps a system running for rows that need the state which earlier rows have left; other rows get a new system.

    Repeating the commands before each row instead would run those of a long file hundreds of times.
    """

    def __init__(self) -> None:
        self._open = ExitStack()
        self._programs: list[Words] = []
        self._history: list[Words] = []
        """The commands so far that have changed the system."""

    def close(self) -> None:
        """End the system."""
        self._open.close()

    def play(self, row: Row, folder: Path) -> Program:
        """Bring the row's system into its state, and run the row's command."""
        for name, text in row["files"].items():
            (folder / name).write_text(text, "utf-8")
        before, changing = row["before"], changing_commands(row["system"])
        done = len(self._history)
        if not (changing and self._programs == row["system"] and self._history == before[:done]):
            self._begin(row, folder)
            done = 0
        self._programs = []  # no row continues with it after a failure
        for words in before[done:]:
            program = start(self._running, filled(words, folder))
            if program.process.wait(5.0) is None:
                self._running.finish(program, 0.0)
        self._history = [*before, row["argv"]] if row["argv"] in changing else [*before]
        program = self._running.finish(start(self._running, filled(row["argv"], folder)), row["stop_after_s"])
        self._programs = row["system"]
        return program

    def _begin(self, row: Row, folder: Path) -> None:
        self.close()
        self._running = self._open.enter_context(system())
        for words in row["system"]:
            start(self._running, filled(words, folder))
        self._running.run(SETTLE if row["system"] else 0.0)


def changing_commands(programs: Sequence[Words]) -> list[Words]:
    """The commands that change a system in a way that a later row needs."""
    return [words for row in rows() if programs and row["system"] == programs for words in row["before"]]


def start(running: System, words: Sequence[str]) -> Program:
    """Start a program or a command from its arguments."""
    return running.python(*words[1:]) if words[0] == "python" else running.ros2(*words[1:])


@pytest.fixture(scope="module")
def systems() -> Iterator[Systems]:
    """The systems that rows have left running."""
    made = Systems()
    yield made
    made.close()


@pytest.mark.parametrize("row", rows(), ids=lambda row: row["id"])
def test_command_output_equals_recording(
    row: Row, systems: Systems, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if usage_of_other_interpreter(row):
        pytest.skip("recorded with the argparse of Python 3.11")
    monkeypatch.chdir(COURSE)
    program = systems.play(row, tmp_path)
    seen = (normal(program.stdout, tmp_path), normal(program.stderr, tmp_path), program.exit)
    recorded = (normal(row["stdout"], tmp_path), normal(row["stderr"], tmp_path), row["exit"])
    assert faults("cli", [row["id"]], {} if seen == recorded else {row["id"]: (recorded, seen)}) == {}


@pytest.mark.skipif(bool(rows()), reason="there are records")
def test_recordings_exist() -> None:
    pytest.skip("BOT_CONSOLE_ORACLE and BOT_CONSOLE_COURSE name no records")
