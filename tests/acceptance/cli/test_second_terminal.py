"""Every command recorded on real ROS 2, typed in a second terminal while the system runs in other processes."""

from __future__ import annotations

import os
import signal
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest
from helpers.processes.mesh import eventually
from helpers.recorded.commands import COURSE, Row, filled, normal, rows, usage_of_other_interpreter
from processes.command_line import CommandLine

ENDLESS = 30.0
"""Seconds after which a command that ends by itself counts as hanging."""

Words = Sequence[str]


def systems() -> list[Any]:
    """The recorded systems that have programs; those with many commands are left to the soak run."""
    names = {row["id"].partition("/")[0]: row["system"] for row in rows() if row["system"]}
    return [
        pytest.param(programs, id=name, marks=() if name in ("duplicates", "step2_overrides") else pytest.mark.soak)
        for name, programs in names.items()
    ]


class Terminals:
    """A system with each program in its own terminal, and one more terminal for commands."""

    def __init__(self, programs: Sequence[Words], folder: Path) -> None:
        self._folder = folder
        self.history: list[Words] = []
        """The commands so far that may have changed the system."""
        self._programs = [self._start(words) for words in programs]
        if not eventually(lambda: len(self._run(["ros2", "node", "list", "--all"], None)[0].split()) > len(programs)):
            self.close()
            raise AssertionError("the programs have not come up")

    def ask(self, row: Row) -> tuple[str, str, int]:
        """Run a command; return its output in the form of the recordings, and its exit code."""
        out, err, code = self._run(row["argv"], row["stop_after_s"])
        return normal(out, self._folder), normal(err, self._folder), code

    def change(self, words: Words) -> None:
        """Run a command for its effect."""
        self._run(words, 20.0)
        self.history.append(words)

    def _run(self, words: Words, stop_after: float | None) -> tuple[str, str, int]:
        process = self._start(words)
        ends = process.has_ended(stop_after or ENDLESS)
        done = process.end(None if ends else signal.SIGINT)
        return done.stdout, done.stderr, done.returncode

    def _start(self, words: Words) -> CommandLine:
        words = filled(words, self._folder)
        if words[1] == "-c":
            (self._folder / "program.py").write_text(words[2], "utf-8")
            words = ["python", str(self._folder / "program.py"), *words[3:]]
        arguments = words[1:] if words[0] == "ros2" else ["run", *words[1:]]
        return CommandLine(*arguments, cwd=COURSE, env={**os.environ, "COLUMNS": "80"})

    def close(self) -> None:
        """End the programs."""
        for each in self._programs:
            each.end(signal.SIGKILL)


def sort_rows(of_system: Sequence[Row]) -> list[Row]:
    """The rows, ordered so that each finds the system as it needs it: rows that change it come last of their kind."""
    changing = [words for row in of_system for words in row["before"]]
    return sorted(of_system, key=lambda row: (len(row["before"]), row["argv"] in changing))


@pytest.mark.timeout(600)
@pytest.mark.parametrize("programs", systems())
def test_commands_in_a_second_terminal_equal_recordings(programs: list[Words], tmp_path: Path):
    of_system = [row for row in rows() if row["system"] == programs and not usage_of_other_interpreter(row)]
    changing = [words for row in of_system for words in row["before"]]
    terminals = Terminals(programs, tmp_path)
    differences: list[tuple[str, object, object]] = []
    try:
        for row in sort_rows(of_system):
            for name, text in row["files"].items():
                (tmp_path / name).write_text(text, "utf-8")
            if row["before"] != terminals.history:
                terminals.close()
                terminals = Terminals(programs, tmp_path)
                for words in row["before"]:
                    terminals.change(words)
            seen = terminals.ask(row)
            if row["argv"] in changing:
                terminals.history.append(row["argv"])
            recorded = (normal(row["stdout"], tmp_path), normal(row["stderr"], tmp_path), row["exit"])
            if seen != recorded:
                differences.append((row["id"], recorded, seen))
    finally:
        terminals.close()
    assert differences == []


@pytest.mark.skipif(bool(rows()), reason="there are records")
def test_recordings_exist() -> None:
    pytest.skip("BOT_CONSOLE_ORACLE and BOT_CONSOLE_COURSE name no records")
