"""The watchdog of a stepped run: a thread that hangs while it holds the baton must not stop all others for ever.

It checks at intervals of wall time, but decides by the state it finds, never by the time that has passed: see
`thread_work`.
"""

from __future__ import annotations

import _thread
from collections.abc import Callable
from typing import TYPE_CHECKING

from .. import real
from ..stepping.baton import LAST
from .thread_work import LOOKS_PER_STALL, ThreadWork

if TYPE_CHECKING:
    from ..stepping.baton import Baton, Seat

START_PATIENCE = 30
"""How many times as long a node may hang in its start before time goes on without it."""
Report = Callable[["Seat", bool], Callable[[], None]]


class StallWatch:
    """Takes the baton from a thread that hangs, in a wait that the run does not see or in a computation."""

    def __init__(self, baton: Baton, stall_s: float, report: Report) -> None:
        """`report(seat, busy)` is called before others go on; what it returns is called once they can.

        `stall_s`: how long (s) a thread must be blocked, and the unit of how long it may compute.
        """
        self._baton = baton
        self._stall_s = stall_s
        self._report = report
        self._running = False
        self._guard = _thread.allocate_lock()
        self._turn: tuple[Seat | None, int] = (None, -1)
        self._works: dict[Seat, ThreadWork] = {}

    def start(self) -> None:
        """Start watching, until no thread but the driver is left."""
        with self._guard:
            if not self._running:
                self._running = True
                # `threading.Thread` would make it a thread of the run that it watches.
                _thread.start_new_thread(self._run, ())

    def _run(self) -> None:
        while self._go_on():
            real.sleep(self._stall_s / LOOKS_PER_STALL)
            seat, turns = turn = self._baton.holder, self._baton.turns
            if turn != self._turn:
                self._turn = turn
                # A new turn: what threads did in earlier ones says nothing.
                self._works.clear()
            if seat is not None:
                self._look_at_holder(seat, turns)
            elif self._baton.starting:
                self._look_at_starting()

    def _look_at_holder(self, seat: Seat, turns: int) -> None:
        work = self._look(seat)
        if work is None:
            return
        busy = work.is_busy(self._stall_s)
        if not busy and not work.is_blocked():
            return
        told = self._baton.detach(seat, turns, lambda seat: self._report(seat, busy))
        if told is not None:
            told()

    def _look_at_starting(self) -> None:
        """Let time go on if all nodes for whose start it stands still hang."""
        works = [self._look(seat) for seat in tuple(self._baton.starting)]
        if all(
            work is not None and (work.is_blocked(START_PATIENCE) or work.is_busy(self._stall_s, START_PATIENCE))
            for work in works
        ):
            self._baton.stop_waiting_for_starts()

    def _look(self, seat: Seat) -> ThreadWork | None:
        """Return the thread's work since its turn began; None for the driver, and for a thread that has not begun."""
        if seat.rank == LAST or not seat.ident:
            return None
        work = self._works.get(seat)
        if work is None:
            work = self._works[seat] = ThreadWork(seat.native_id, seat.ident)
        work.look()
        return work

    def _go_on(self) -> bool:
        with self._guard:
            self._running = any(rank != LAST for rank in tuple(self._baton.seats))
            return self._running
