"""A console's tuner: a study in a thread, with its runs in processes alongside the running robot."""

from __future__ import annotations

import threading
from dataclasses import replace
from pathlib import Path

from bot_console.tui.cli.system.workspaces import SYSTEM_NODES
from bot_console.tui.cli.tune.pool import CAN_FORK, Pool
from bot_console.tui.cli.tune.saving import save_profile
from bot_console.tui.console.answer import Answer
from bot_console.tui.files.folders import state_folder
from bot_console.tui.files.save_file import NotSaved
from bot_console.tui.tuning.dial import Setting
from bot_console.tui.tuning.journal import Journal
from bot_console.tui.tuning.question import Question
from bot_console.tui.tuning.study import Progress, Study


class LocalTuner:
    """Forks the runs on this machine. It works on one question at a time; a new one ends the one before."""

    def __init__(self, folder: Path | None = None) -> None:
        self._folder = folder or state_folder() / "tune"
        self._pool: Pool | None = None
        self._tuning: LocalTuning | None = None

    def problem(self, question: Question) -> str:
        """Why a question cannot be answered; empty when it can."""
        if not CAN_FORK:
            return "this system cannot fork processes, which runs side by side need"
        strange = [each.label for each in question.dials if each.node not in SYSTEM_NODES]
        if strange:
            return f"{', '.join(strange)}: only nodes of the robot that comes along are in the simulated runs"
        return question.problem()

    def begin(self, question: Question) -> LocalTuning:
        """Start, or resume from what the journal knows."""
        if self._tuning is not None:
            self._tuning.stop()
        if self._pool is None:
            self._pool = Pool()
        self._tuning = LocalTuning(question, self._pool, self._folder)
        return self._tuning

    def close(self) -> None:
        """End all runs, and wait for that."""
        if self._tuning is not None:
            self._tuning.stop()
        if self._pool is not None:
            self._pool.close()


class LocalTuning:
    """A study and its thread."""

    def __init__(self, question: Question, pool: Pool, folder: Path) -> None:
        self._question = question
        self._pool = pool
        self._folder = folder
        self._study: Study | None = None
        self._problem = ""
        self._stopped = False
        self.thread = threading.Thread(target=self._run, name="tune", daemon=True)
        self.thread.start()

    @property
    def progress(self) -> Progress:
        """The progress so far."""
        if self._problem:
            return Progress(ended=True, problem=self._problem)
        return self._study.progress if self._study is not None else Progress()

    def stop(self) -> None:
        """Stop after the runs in progress."""
        self._stopped = True
        if self._study is not None:
            self._study.stop()

    def save(self, name: str, setting: Setting) -> Answer:
        """Save the profile with a setting's values."""
        judged = next((each for each in self.progress.rows if each.setting == setting), None)
        if judged is None:
            return Answer(False, "nothing is known of this setting yet")
        try:
            return Answer(True, save_profile(name, self._question, judged))
        except NotSaved as error:
            return Answer(False, f"not saved: {error}")

    def _run(self) -> None:
        try:
            journal = Journal(self._folder, self._question, resume=True)
        except OSError as error:
            self._problem = f"the journal cannot be written: {error}"
            return
        self._study = Study(self._question, self._pool, journal)
        if self._stopped:
            self._study.stop()
        try:
            self._study.run()
        except RuntimeError:  # the pool has been closed: the console ends
            self._study.progress = replace(self._study.progress, ended=True, problem="stopped")
        finally:
            journal.close()
