"""Tries the means of stopping one after the other, without waiting for any of them."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Sequence

from bot_console.tui.console.robot.stop_means.means import Status, StopMeans

NEXT_AFTER_S = 0.3
"""Seconds after which the next means is tried unless one holds; after a failure, it is tried sooner."""
AGAIN_AFTER_S = 1.0
"""Seconds after the last means until the first one is tried again."""

TICK_S = 0.1
"""Seconds between two calls of `tick`."""


class StopSequence:
    """Tries the configured means of stopping in order. Methods may be called from any thread, and return at once."""

    def __init__(self, means: Sequence[StopMeans], now: Callable[[], float] = time.monotonic) -> None:
        """`now` returns seconds."""
        self._means = means
        self._now = now
        self._lock = threading.RLock()
        self._holding = False
        self._next = 0
        self._due = 0.0
        self._tried: set[int] = set()

    @property
    def configured(self) -> bool:
        """Whether any means is configured."""
        return bool(self._means)

    @property
    def holds(self) -> str:
        """The name of a means that has confirmed that it holds the robot; empty if none has."""
        if not self._holding:
            return ""
        return next((each.name for each in self._means if each.status is Status.HOLDS), "")

    @property
    def news(self) -> str:
        """The result of the means tried last; after a release, which of them could not be undone."""
        with self._lock:
            if self._holding:
                last = self._means[(self._next or len(self._means)) - 1] if self._tried else None
                return f"{last.name} {last.problem or 'has not answered yet'}" if last else ""
            failed = [each for each in self._means if each.status in (Status.FAILED, Status.RELEASING)]
            return "; ".join(f"{each.name} {each.problem or 'has not answered yet'}" for each in failed)

    def hold(self) -> None:
        """Try the first means now; `tick` continues with the next ones."""
        with self._lock:
            if self._means:
                self._holding, self._next = True, 0
                self._try_next()

    def release(self) -> None:
        """Undo every means that was tried."""
        with self._lock:
            self._holding = False
            for at in sorted(self._tried):
                self._ask(self._means[at], self._means[at].release)
            self._tried.clear()

    def tick(self) -> None:
        """Continue the sequence; to be called ten times a second."""
        with self._lock:
            if not self._holding:
                return
            for at in self._tried:
                self._ask(self._means[at], self._means[at].refresh)
            failed = self._next > 0 and self._means[self._next - 1].status is Status.FAILED
            if not self.holds and (failed or self._now() + TICK_S / 2 >= self._due):
                self._try_next()

    def _try_next(self) -> None:
        means = self._means[self._next]
        self._tried.add(self._next)
        self._next = (self._next + 1) % len(self._means)
        self._due = self._now() + (NEXT_AFTER_S if self._next else AGAIN_AFTER_S)
        self._ask(means, means.hold)

    @staticmethod
    def _ask(means: StopMeans, step: Callable[[], None]) -> None:
        """Run a step of a means; its failure must not keep zeros or the next means from being sent."""
        try:
            step()
        except Exception as error:
            means.status, means.problem = Status.FAILED, str(error)
