"""The tuner of a console: runs a tuning job in a thread, and its simulator runs in separate processes."""

from __future__ import annotations

import threading
from dataclasses import replace
from pathlib import Path

from bot_console.tui.cli.tune.pool import CAN_FORK, Pool
from bot_console.tui.cli.tune.saving import save_profile
from bot_console.tui.console.answer import Answer
from bot_console.tui.files.folders import state_folder
from bot_console.tui.files.save_file import NotSaved
from bot_console.tui.session.embedded.workspaces import SYSTEM_NODES
from bot_console.tui.tuning.job import Progress, TuningJob
from bot_console.tui.tuning.run_journal import TuningJournal
from bot_console.tui.tuning.specification import TuningSpecification
from bot_console.tui.tuning.tunable import Setting


class LocalTuner:
    """Forks the runs on this machine. It works on one job at a time: starting another one stops the present one."""

    def __init__(self, folder: Path | None = None) -> None:
        self._folder = folder or state_folder() / "tune"
        self._pool: Pool | None = None
        self._tuning: LocalTuning | None = None

    def problem(self, specification: TuningSpecification) -> str:
        """Why a specification cannot be tuned; empty if it can."""
        if not CAN_FORK:
            return "this system cannot fork processes, which concurrent runs need"
        strange = [each.label for each in specification.tunables if each.node not in SYSTEM_NODES]
        if strange:
            return f"{', '.join(strange)}: only nodes of the bundled robot are in the simulated runs"
        return specification.problem()

    def begin(self, specification: TuningSpecification) -> LocalTuning:
        """Start a job, or resume it with the runs in the journal."""
        if self._tuning is not None:
            self._tuning.stop()
        if self._pool is None:
            self._pool = Pool()
        self._tuning = LocalTuning(specification, self._pool, self._folder)
        return self._tuning

    def close(self) -> None:
        """End all runs, and wait until they have ended."""
        if self._tuning is not None:
            self._tuning.stop()
        if self._pool is not None:
            self._pool.close()


class LocalTuning:
    """A tuning job and its thread."""

    def __init__(self, specification: TuningSpecification, pool: Pool, folder: Path) -> None:
        self._specification = specification
        self._pool = pool
        self._folder = folder
        self._job: TuningJob | None = None
        self._problem = ""
        self._stopped = False
        self.thread = threading.Thread(target=self._run, name="tune", daemon=True)
        self.thread.start()

    @property
    def progress(self) -> Progress:
        """The progress so far."""
        if self._problem:
            return Progress(ended=True, problem=self._problem)
        return self._job.progress if self._job is not None else Progress()

    def stop(self) -> None:
        """Stop after the runs in progress."""
        self._stopped = True
        if self._job is not None:
            self._job.stop()

    def save(self, name: str, setting: Setting) -> Answer:
        """Save the tuned profile with the values of a setting."""
        result = next((each for each in self.progress.rows if each.setting == setting), None)
        if result is None:
            return Answer(False, "nothing is known about this setting yet")
        try:
            return Answer(True, save_profile(name, self._specification, result))
        except NotSaved as error:
            return Answer(False, f"not saved: {error}")

    def _run(self) -> None:
        try:
            journal = TuningJournal(self._folder, self._specification, resume=True)
        except OSError as error:
            self._problem = f"the journal cannot be written: {error}"
            return
        self._job = TuningJob(self._specification, self._pool, journal)
        if self._stopped:
            self._job.stop()
        try:
            self._job.run()
        except RuntimeError:  # the pool has been closed, since the console is ending
            self._job.progress = replace(self._job.progress, ended=True, problem="stopped")
        finally:
            journal.close()
