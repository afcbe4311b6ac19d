"""The tuner of a console: its refusals, and that closing ends its runs."""

from __future__ import annotations

from pathlib import Path

from bot_console.tui.cli.tune import background_tuner
from bot_console.tui.tuning.score import parse_score
from bot_console.tui.tuning.specification import TuningSpecification
from bot_console.tui.tuning.tunable import Tunable

SPEED = Tunable("/robot_navigator", "max_speed", "double", 0.1, 5.0, 1.0)


def test_only_parameters_of_simulated_nodes_can_be_tuned(tmp_path: Path) -> None:
    asked = background_tuner.LocalTuner(tmp_path)
    assert asked.problem(TuningSpecification((SPEED,), parse_score("swift"))) == ""
    mine = Tunable("/mine", "gain", "double", 0, 1, 0.5)
    assert asked.problem(TuningSpecification((SPEED, mine), parse_score("swift"))).startswith(
        "/mine:gain: only nodes of the bundled robot"
    )
    assert "too few" in asked.problem(TuningSpecification((SPEED,), parse_score("swift"), runs=2))


def test_unwritable_journal_is_reported(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    tuning = background_tuner.LocalTuning(TuningSpecification((SPEED,), parse_score("swift")), None, tmp_path / "file")  # type: ignore[arg-type]
    tuning.thread.join(240)
    assert tuning.progress.ended
    assert "the journal cannot be written" in tuning.progress.problem
    assert not tuning.save("x", (1.0,)).ok


def test_closing_an_unused_tuner_does_nothing(tmp_path: Path) -> None:
    background_tuner.LocalTuner(tmp_path).close()
