"""Watches in wall time over a stepped run: a thread that keeps the baton must not stop all others for ever."""

from __future__ import annotations

import _thread
from collections.abc import Callable
from typing import TYPE_CHECKING

from . import real
from .baton import LAST

if TYPE_CHECKING:
    from .baton import Baton, Seat

LOOKS_PER_STALL = 4


class StallWatch:
    """Takes the baton from a thread that has not come back to it for `stall_s` s of wall time."""

    def __init__(self, baton: Baton, stall_s: float, report: Callable[[Seat], Callable[[], None]]) -> None:
        """`report(seat)` is called before others go on, and what it returns when they can."""
        self._baton = baton
        self._stall_s = stall_s
        self._report = report
        self._running = False
        self._guard = _thread.allocate_lock()

    def start(self) -> None:
        """Watch from now on, until no thread but the driver is left."""
        with self._guard:
            if not self._running:
                self._running = True
                _thread.start_new_thread(self._run, ())

    def _run(self) -> None:
        seen, looks = -1, 0
        while self._go_on():
            real.sleep(self._stall_s / LOOKS_PER_STALL)
            seat, turns = self._baton.holder, self._baton.turns
            looks = looks + 1 if turns == seen else 0
            seen = turns
            if looks >= LOOKS_PER_STALL and seat is not None and seat.rank != LAST:
                looks = 0
                told = self._baton.detach(seat, turns, self._report)
                if told is not None:
                    told()

    def _go_on(self) -> bool:
        with self._guard:
            self._running = any(rank != LAST for rank in tuple(self._baton.seats))
            return self._running
