"""A tuning job: asks the search for settings, runs them in parallel, and keeps the table of results."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, wait
from dataclasses import dataclass, field
from typing import Any, Protocol

from bot_console.tui.tuning.run_journal import TuningJournal
from bot_console.tui.tuning.score import FAILED
from bot_console.tui.tuning.search import TriedSetting, next_settings
from bot_console.tui.tuning.specification import Trial, TuningSpecification
from bot_console.tui.tuning.tunable import Setting


class Runner(Protocol):
    """Runs the simulator; the report of a run that failed has a key `problem`."""

    def begin(self, specification: TuningSpecification, trial: Trial) -> Future[Mapping[str, Any]]:
        """Start a run as soon as there is capacity."""
        ...


@dataclass(frozen=True)
class SettingResult:
    """A setting and the results of its runs."""

    setting: Setting
    score: float
    """The mean score of its runs; minus infinity if one failed."""
    scores: tuple[float, ...] = ()
    collisions: int = 0
    problem: str = ""
    """Why a run failed; empty if none did."""


@dataclass(frozen=True)
class Progress:
    """The progress of a tuning job; the same object until something has changed."""

    rows: tuple[SettingResult, ...] = ()
    """The settings in the order in which they were tried; the first is the initial one."""
    done: int = 0
    runs: int = 0
    """The maximum number of runs, including those on held-out seeds."""
    elapsed: float = 0.0
    """Seconds since the start."""
    fresh: int = 0
    """Runs made by this job, not taken from the journal."""
    held_out: tuple[SettingResult, SettingResult] | None = None
    """The initial setting and the best one, evaluated on held-out seeds."""
    ended: bool = False
    problem: str = ""
    """Why it ended early; empty if it did not."""

    @property
    def best(self) -> SettingResult | None:
        """The setting with the highest score; None while no setting has one."""
        scored = [each for each in self.rows if math.isfinite(each.score)]
        return max(scored, key=lambda each: each.score) if scored else None

    @property
    def left(self) -> float | None:
        """The estimated seconds left; None while unknown."""
        return self.elapsed / self.fresh * (self.runs - self.done) if self.fresh else None


@dataclass
class TuningJob:
    """Runs a tuning specification in the calling thread; `progress` and `stop` may be called from any other."""

    specification: TuningSpecification
    runner: Runner
    journal: TuningJournal
    changed: Callable[[Progress], None] = lambda progress: None
    clock: Callable[[], float] = time.monotonic
    progress: Progress = field(default_factory=Progress)
    _stopped: bool = False

    def stop(self) -> None:
        """Stop after the runs in progress; results so far are kept."""
        self._stopped = True

    def run(self) -> Progress:
        """Search, then evaluate the best setting on held-out seeds."""
        specification, self._began = self.specification, self.clock()
        self._rows: list[SettingResult] = []
        self._going_on: Mapping[Setting, Sequence[Trial]] = {}
        self._done = self._fresh = 0
        self._planned = specification.settings * specification.seeds * len(specification.worlds)
        self._planned += 2 * len(specification.held_out_trials(()))
        held_out: tuple[SettingResult, SettingResult] | None = None
        try:
            while settings := self._next():
                self._going_on = {each: specification.trials(each) for each in settings}
                self._rows += self._evaluate(self._going_on)
                self._going_on = {}
            best = self._best()
            if best is not None and specification.held_out and not self._stopped:
                both = (self._rows[0].setting, best.setting)
                chosen = [*self._evaluate({each: specification.held_out_trials(each) for each in both})]
                held_out = (chosen[0], chosen[-1])  # the same one, if no setting was better than the initial one
            problem = "stopped" if self._stopped else self._all_failed()
        except _Stopped:
            problem = "stopped"
        except OSError as error:
            problem = f"the journal cannot be written: {error}"
        self._report(held_out=held_out, ended=True, problem=problem)
        return self.progress

    def _all_failed(self) -> str:
        return "" if self._best() else f"every setting failed: {self._rows[0].problem if self._rows else 'stopped'}"

    def _next(self) -> Sequence[Setting]:
        if self._stopped:
            return ()
        specification = self.specification
        tried = [TriedSetting(each.setting, each.score) for each in self._rows]
        return next_settings(
            specification.search, specification.tunables, specification.settings, specification.seed, tried
        )

    def _evaluate(self, wanted: Mapping[Setting, Sequence[Trial]]) -> list[SettingResult]:
        """Evaluate settings by the trials of each, in parallel."""
        every = list(dict.fromkeys(trial for each in wanted.values() for trial in each))
        running: dict[Future[Mapping[str, Any]], Trial] = {}
        for trial in every:
            if self.journal.report(trial) is None:
                running[self.runner.begin(self.specification, trial)] = trial
            else:
                self._done += 1
        self._report()
        while running:
            ended, _ = wait(running, return_when=FIRST_COMPLETED)
            for each in ended:
                self._record(running.pop(each), each)
            if self._stopped:
                for each in running:
                    each.cancel()
                raise _Stopped
            self._report()
        return [self._result_of(setting, mine) for setting, mine in wanted.items()]

    def _record(self, trial: Trial, ended: Future[Mapping[str, Any]]) -> None:
        if ended.cancelled():
            raise _Stopped
        error = ended.exception()
        self.journal.add(trial, {"problem": str(error)} if error else ended.result())
        self._done += 1
        self._fresh += 1

    def _result_of(self, setting: Setting, trials: Sequence[Trial]) -> SettingResult:
        scores: list[float] = []
        collisions, problem = 0, ""
        for trial in trials:
            report = self.journal.report(trial) or {}
            try:
                if report.get("problem"):
                    raise ValueError(report["problem"])
                scores.append(self.specification.score.of(report))
                collisions += int(report.get("collisions") or 0)
            except ValueError as error:
                problem = problem or f"seed {trial.seed}: {error}"
        mean = math.fsum(scores) / len(scores) if scores and not problem else FAILED
        return SettingResult(setting, mean, tuple(scores), collisions, problem)

    def _best(self) -> SettingResult | None:
        return Progress(tuple(self._rows)).best

    def _so_far(self) -> tuple[SettingResult, ...]:
        """The evaluated settings, with those of the current generation whose runs have all ended."""
        known = self.journal.report
        ended = [each for each in self._going_on.items() if all(known(trial) is not None for trial in each[1])]
        return (*self._rows, *(self._result_of(*each) for each in ended))

    def _report(
        self, *, held_out: tuple[SettingResult, SettingResult] | None = None, ended: bool = False, problem: str = ""
    ) -> None:
        elapsed = self.clock() - self._began
        runs = self._done if ended else self._planned
        self.progress = Progress(self._so_far(), self._done, runs, elapsed, self._fresh, held_out, ended, problem)
        self.changed(self.progress)


class _Stopped(Exception):
    """Raised when the job was asked to stop."""
