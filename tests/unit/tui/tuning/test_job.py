"""A tuning from beginning to end, with runs that cost nothing; and its journal."""

from __future__ import annotations

from collections.abc import Mapping
from concurrent.futures import Future
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from bot_console.tui.tuning.job import Progress, TuningJob
from bot_console.tui.tuning.run_journal import TuningJournal
from bot_console.tui.tuning.score import parse_score
from bot_console.tui.tuning.specification import HELD_OUT, Trial, TuningSpecification
from bot_console.tui.tuning.tunable import Tunable

SPEED = Tunable("/navigator", "speed", "double", 0.0, 4.0, 1.0)
QUESTION = TuningSpecification(
    (SPEED,), parse_score("mean_speed - 2*collisions"), runs=12, seeds=2, held_out=2, search="grid"
)


def report(trial: Trial) -> dict[str, Any]:
    """The report of a run: faster is better until it collides, and seeds differ a little."""
    speed = float(trial.setting[0])
    return {"mean_speed": speed + 0.01 * trial.seed, "collisions": int(speed > 3)}


class InstantRunner:
    """A runner whose runs end at once; `fail` names the seeds whose runs fail."""

    def __init__(self, fail: tuple[int, ...] = ()) -> None:
        self.begun: list[Trial] = []
        self._fail = fail

    def begin(self, specification: TuningSpecification, trial: Trial) -> Future[Mapping[str, Any]]:
        self.begun.append(trial)
        future: Future[Mapping[str, Any]] = Future()
        if trial.seed in self._fail:
            future.set_result({"problem": "max_speed refused"})
        else:
            future.set_result(report(trial))
        return future


def tuned(
    folder: Path, runner: InstantRunner, specification: TuningSpecification = QUESTION, *, resume: bool = False
) -> Progress:
    journal = TuningJournal(folder, specification, resume=resume)
    try:
        return TuningJob(specification, runner, journal, clock=iter(range(10_000)).__next__).run()
    finally:
        journal.close()


def test_the_best_setting_is_found_and_evaluated_on_seeds_that_it_was_not_chosen_by(tmp_path: Path) -> None:
    runner = InstantRunner()
    progress = tuned(tmp_path, runner)
    best = progress.best
    assert best is not None
    assert (progress.rows[0].setting, best.setting) == ((1.0,), (3.0,))
    assert best.score == pytest.approx(3.0 + 0.015)
    assert {each.seed for each in runner.begun} == {1, 2, 1 + HELD_OUT, 2 + HELD_OUT}
    assert progress.held_out is not None
    before, after = progress.held_out
    assert (before.setting, after.setting) == ((1.0,), (3.0,))
    assert (progress.done, progress.ended, progress.problem) == (len(runner.begun), True, "")


def test_setting_with_a_failed_run_has_failed_with_its_reason(tmp_path: Path) -> None:
    progress = tuned(tmp_path, InstantRunner(fail=(2,)))
    assert progress.best is None
    assert progress.rows[0].problem == "seed 2: max_speed refused"
    assert progress.problem == "every setting failed: seed 2: max_speed refused"


def test_best_setting_is_the_present_one_if_none_is_better(tmp_path: Path) -> None:
    progress = tuned(tmp_path, InstantRunner(), replace(QUESTION, tunables=(replace(SPEED, now=3.0),)))
    assert progress.held_out is not None
    assert progress.held_out[0] == progress.held_out[1]


@pytest.mark.parametrize("left", [10, -1], ids=["within a line", "before its end of line"])
def test_interrupted_tuning_resumes_with_the_same_result(tmp_path: Path, left: int) -> None:
    whole = tuned(tmp_path / "whole", InstantRunner())
    tuned(tmp_path, InstantRunner())
    file = next(tmp_path.glob("*.jsonl"))
    lines = file.read_bytes().splitlines(keepends=True)
    file.write_bytes(b"".join(lines[:5]) + lines[5][:left])
    runner = InstantRunner()
    again = tuned(tmp_path, runner, resume=True)
    assert len(runner.begun) == len(lines) - 5
    assert (again.rows, again.held_out, again.done) == (whole.rows, whole.held_out, whole.done)
    assert file.read_bytes().splitlines(keepends=True)[:5] == lines[:5]
    assert len(file.read_bytes().splitlines()) == len(lines)


def test_tuning_starts_again_without_resume(tmp_path: Path) -> None:
    tuned(tmp_path, InstantRunner())
    runner = InstantRunner()
    tuned(tmp_path, runner)
    assert len(runner.begun) == 14


@pytest.mark.parametrize("other", [{"duration": 30.0}, {"seed": 2}, {"profile": "outdoor"}, {"base": {"/a": {"b": 1}}}])
def test_other_specification_uses_another_journal(other: dict[str, Any]) -> None:
    assert replace(QUESTION, **other).digest != QUESTION.digest


def test_stopping_keeps_the_best_setting_found(tmp_path: Path) -> None:
    journal = TuningJournal(tmp_path, QUESTION, resume=False)
    job = TuningJob(QUESTION, InstantRunner(), journal)
    job.changed = lambda progress: job.stop() if progress.done else None
    progress = job.run()
    assert progress.problem == "stopped"
    assert progress.ended
    assert progress.held_out is None
    journal.close()


def test_remaining_time_is_estimated_from_finished_runs() -> None:
    assert Progress(done=10, runs=40, elapsed=20.0, fresh=5).left == 120.0
    assert Progress(done=10, runs=40, elapsed=20.0).left is None


@pytest.mark.parametrize(
    ("change", "why"),
    [({"runs": 3}, "each setting takes 2; give at least 4"), ({"seeds": 0}, "must be positive"), ({}, "")],
)
def test_invalid_numbers_are_rejected(change: dict[str, Any], why: str) -> None:
    problem = replace(QUESTION, **change).problem()
    assert why in problem
    assert bool(why) == bool(problem)


def test_run_uses_the_systems_values_overridden_by_the_setting() -> None:
    specification = replace(QUESTION, base={"/navigator": {"speed": 1.0, "turn": 2.0}})
    assert specification.values((3.0,)) == {"/navigator": {"speed": 3.0, "turn": 2.0}}
