"""The watchdog of a stepped run: a thread that hangs while it holds the turn must not stop all others for ever.

It checks at intervals of wall time, but decides by the state of the thread, never by the time that has passed: see
`thread_work`.
"""

from __future__ import annotations

import _thread
from collections.abc import Callable
from typing import TYPE_CHECKING

from .. import unpatched
from ..stepping.scheduler import LAST
from .thread_work import CHECKS_PER_STALL, ThreadWork

if TYPE_CHECKING:
    from ..stepping.scheduler import ScheduledTask, Scheduler

START_STALL_FACTOR = 30
"""Factor for how much longer a node may block during its start before time continues without it."""
Report = Callable[["ScheduledTask", bool], Callable[[], None]]


class StallWatch:
    """Takes the turn from a thread that hangs, in a wait that the run does not see or in an endless computation."""

    def __init__(self, scheduler: Scheduler, stall_s: float, report: Report) -> None:
        """`report(task, busy)` is called before others continue; the function it returns is called once they can.

        `stall_s` is how long (s) a thread must be blocked; how long it may compute is a multiple of that.
        """
        self._scheduler = scheduler
        self._stall_s = stall_s
        self._report = report
        self._running = False
        self._guard = _thread.allocate_lock()
        self._turn: tuple[ScheduledTask | None, int] = (None, -1)
        self._works: dict[ScheduledTask, ThreadWork] = {}

    def start(self) -> None:
        """Start watching, until no thread but the driver is left."""
        with self._guard:
            if not self._running:
                self._running = True
                # `threading.Thread` would make it a thread of the run that it watches.
                _thread.start_new_thread(self._run, ())

    def _run(self) -> None:
        while self._go_on():
            unpatched.sleep(self._stall_s / CHECKS_PER_STALL)
            task, turns = turn = self._scheduler.holder, self._scheduler.turns
            if turn != self._turn:
                self._turn = turn
                # A new turn: what the threads did in earlier ones no longer matters.
                self._works.clear()
            if task is not None:
                self._inspect_holder(task, turns)
            elif self._scheduler.starting:
                self._inspect_starting()

    def _inspect_holder(self, task: ScheduledTask, turns: int) -> None:
        work = self._poll(task)
        if work is None:
            return
        busy = work.is_busy(self._stall_s)
        if not busy and not work.is_blocked():
            return
        report = self._scheduler.detach(task, turns, lambda task: self._report(task, busy))
        if report is not None:
            report()

    def _inspect_starting(self) -> None:
        """Let time continue if all nodes whose starts stop the clock hang."""
        works = [self._poll(task) for task in tuple(self._scheduler.starting)]
        if all(
            work is not None
            and (work.is_blocked(START_STALL_FACTOR) or work.is_busy(self._stall_s, START_STALL_FACTOR))
            for work in works
        ):
            self._scheduler.stop_waiting_for_starts()

    def _poll(self, task: ScheduledTask) -> ThreadWork | None:
        """Return the thread's work since its turn began; None for the driver, and for a thread that has not begun."""
        if task.rank == LAST or not task.ident:
            return None
        work = self._works.get(task)
        if work is None:
            work = self._works[task] = ThreadWork(task.native_id, task.ident)
        work.poll()
        return work

    def _go_on(self) -> bool:
        with self._guard:
            self._running = any(rank != LAST for rank in tuple(self._scheduler.tasks))
            return self._running
