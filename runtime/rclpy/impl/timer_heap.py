"""Timers of an executor by the steady time at which they are due."""

from __future__ import annotations

import heapq
from typing import Any


class TimerHeap:
    """A heap of (deadline ns, creation, timer); entries that were overtaken are left in and skipped."""

    def __init__(self) -> None:
        self._heap: list[tuple[int, int, Any]] = []

    def push(self, deadline: int, timer: Any) -> None:
        """A timer is due at a steady time."""
        timer.heap_deadline = deadline
        heapq.heappush(self._heap, (deadline, timer.order, timer))

    def next_deadline(self, sink: Any) -> int | None:
        """When the next timer of this executor is due; None without one."""
        heap = self._heap
        while heap:
            deadline, _, timer = heap[0]
            if timer.heap_deadline == deadline and timer.sink is sink:
                return deadline
            heapq.heappop(heap)
        return None

    def pop_due(self, now: int, sink: Any) -> list[Any]:
        """Timers that are due, taken out."""
        due: list[Any] = []
        heap = self._heap
        while heap and heap[0][0] <= now:
            deadline, _, timer = heapq.heappop(heap)
            if timer.heap_deadline == deadline and timer.sink is sink:
                timer.heap_deadline = None
                due.append(timer)
        return due
