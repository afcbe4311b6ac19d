"""Replaces one running system with another: everything is stopped before anything is launched."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from concurrent.futures import Future
from dataclasses import dataclass, field

from bot_console.tui.console.answer import Answer, answer_of
from bot_console.tui.console.launch.port import Launcher
from bot_console.tui.console.model import Profile


@dataclass
class Replacement:
    """Stops processes, launches a profile once all of them have ended, and reports the outcome."""

    launcher: Launcher
    keys: Sequence[str]
    profile: Profile
    report: Callable[[Answer], object]
    _left: int = 0
    _problems: list[str] = field(default_factory=list[str])
    _lock: threading.Lock = field(default_factory=threading.Lock)

    def begin(self) -> None:
        """Ask all processes to stop."""
        self._left = len(self.keys)
        if not self.keys:
            self._launch()
        for key in self.keys:
            self.launcher.stop(key).add_done_callback(self._stopped)

    def _stopped(self, done: Future[Answer]) -> None:
        answer = answer_of(done)
        with self._lock:
            self._left -= 1
            if not answer.ok:
                self._problems.append(answer.text)
            last = self._left == 0
        if last and self._problems:
            self.report(Answer(False, f"{self.profile.name} was not launched: {'; '.join(self._problems)}"))
        elif last:
            self._launch()

    def _launch(self) -> None:
        self.launcher.launch(self.profile.launch, self.profile.arguments).add_done_callback(self._launched)

    def _launched(self, done: Future[Answer]) -> None:
        answer = answer_of(done)
        text = answer.text or self.profile.launch
        self.report(Answer(answer.ok, f"{self.profile.name}: {text}" if answer.ok else f"not launched: {text}"))
