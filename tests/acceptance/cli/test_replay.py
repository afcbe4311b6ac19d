"""Every command recorded on real ROS 2 gives the same output and exit code here, run on the same system."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pytest
from helpers.recorded.cases import faults
from helpers.recorded.commands import COURSE, Row, filled, normal, rows, usage_of_other_interpreter
from systems import Program, System, system

SETTLE = 1.0
"""Seconds that the programs of a system run before the first command."""


def play(row: Row, running: System, folder: Path) -> Program:
    """Start the row's system, run the commands before the row, then the row's own."""
    for name, text in row["files"].items():
        (folder / name).write_text(text, "utf-8")
    for words in row["system"]:
        start(running, filled(words, folder))
    running.run(SETTLE if row["system"] else 0.0)
    for words in row["before"]:
        program = start(running, filled(words, folder))
        if program.process.wait(5.0) is None:
            running.finish(program, 0.0)
    return running.finish(start(running, filled(row["argv"], folder)), row["stop_after_s"])


def start(running: System, words: Sequence[str]) -> Program:
    """Start a program or a command by its words."""
    return running.python(*words[1:]) if words[0] == "python" else running.ros2(*words[1:])


@pytest.mark.parametrize("row", rows(), ids=lambda row: row["id"])
def test_command_output_equals_recording(row: Row, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    if usage_of_other_interpreter(row):
        pytest.skip("recorded with the argparse of Python 3.11")
    monkeypatch.chdir(COURSE)
    with system() as running:
        program = play(row, running, tmp_path)
    seen = (normal(program.stdout, tmp_path), normal(program.stderr, tmp_path), program.exit)
    recorded = (normal(row["stdout"], tmp_path), normal(row["stderr"], tmp_path), row["exit"])
    assert faults("cli", [row["id"]], {} if seen == recorded else {row["id"]: (recorded, seen)}) == {}


@pytest.mark.skipif(bool(rows()), reason="there are records")
def test_recordings_exist() -> None:
    pytest.skip("BOT_CONSOLE_ORACLE and BOT_CONSOLE_COURSE name no records")
