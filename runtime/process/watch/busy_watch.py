"""Detect nodes that compute without ever waiting: they take the CPU from all others, and receive nothing."""

from __future__ import annotations

from _thread import allocate_lock
from typing import TYPE_CHECKING

from .. import frames, real
from ..notices import notify
from .processor_time import thread_seconds

if TYPE_CHECKING:
    from ..roles import NodeThread, Watched

PERIOD_S = 0.5
"""Wall time (s) between two checks."""
BUSY_SHARE = 0.5
"""Share of a processor from which a thread that never waits counts as computing."""
REPORT_S = 1.0
"""Processor time (s) after which such a thread is reported."""


class BusyWatch:
    """Watches the node processes of real time, from the first until the last."""

    def __init__(self) -> None:
        self._guard = allocate_lock()
        self._processes: set[Watched] = set()
        self._last: dict[NodeThread, tuple[int, float, float]] = {}

    def watch(self, process: Watched) -> None:
        """Watch a process until it ends."""
        with self._guard:
            first = not self._processes
            self._processes.add(process)
        if first:
            real.later(PERIOD_S, self._poll)

    def process_of(self, ident: int) -> Watched | None:
        """Return the process of a thread; None if no watched process has it."""
        with self._guard:
            processes = tuple(self._processes)
        return next((each for each in processes if any(state.ident == ident for state in each.thread_states())), None)

    def _poll(self) -> None:
        with self._guard:
            self._processes = {process for process in self._processes if process.is_alive}
            processes = tuple(self._processes)
        before, self._last = self._last, {}
        for process in processes:
            for state in process.thread_states():
                self._inspect(process, state, before.get(state))
        if processes:
            real.later(PERIOD_S, self._poll)

    def _inspect(self, process: Watched, state: NodeThread, before: tuple[int, float, float] | None) -> None:
        seconds = thread_seconds(state.thread.native_id or 0)
        if state.waiting or seconds is None:
            return
        waits, seconds_before, computed_before = before or (state.waits, seconds, 0.0)
        used, computed = seconds - seconds_before, 0.0
        if waits == state.waits and used >= BUSY_SHARE * PERIOD_S and not frames.is_importing(state.ident):
            computed = computed_before + used
        self._last[state] = (state.waits, seconds, computed)
        if computed_before < REPORT_S <= computed:
            line = frames.thread_line(state.ident)
            notify(
                process,
                f"has computed for {REPORT_S:g} s without waiting, in {line}. It slows all other nodes down "
                "and cannot be stopped politely: let it spin, sleep or wait in its loop",
            )


busy_watch = BusyWatch()
