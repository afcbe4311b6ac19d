"""The deadline queue of an executor: its timers by the steady time at which they are due."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

from heapq import heappop, heappush, heapreplace
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rclpy.impl.entity import Entity


class TimerHeap:
    """A heap of (deadline ns, creation, timer), with one entry for each timer.

    A postponed timer keeps its earlier entry, which is moved to the later deadline when it reaches the top. Pushes come
    from any thread: heap operations on these tuples do not run Python code, so they need no lock.
    """

    def __init__(self) -> None:
        self.entries: list[tuple[int, int, Entity]] = []

    def push(self, deadline: int, timer: Entity) -> None:
        """Set the steady time (ns) at which a timer is due, replacing its previous deadline."""
        timer.due_at = deadline
        if timer.heap is self and timer.heap_deadline <= deadline:
            return
        timer.heap = self
        timer.heap_deadline = deadline
        heappush(self.entries, (deadline, timer.order, timer))

    def next_deadline(self, sink: object) -> int | None:
        """Return the deadline (steady ns) of the executor's next timer; None if there is none."""
        entries = self.entries
        while entries:
            entry = entries[0]
            deadline, _, timer = entry
            if timer.heap_deadline == deadline >= timer.due_at and timer.heap is self and timer.sink is sink:
                return deadline
            self._put_right(entry, sink)
        return None

    def pop_due(self, now: int, sink: object) -> list[Entity]:
        """Remove and return the timers that are due."""
        due: list[Entity] = []
        entries = self.entries
        while entries and entries[0][0] <= now:
            entry = entries[0]
            deadline, _, timer = entry
            if timer.heap_deadline == deadline >= timer.due_at and timer.heap is self and timer.sink is sink:
                heappop(entries)
                timer.heap = None
                due.append(timer)
            else:
                self._put_right(entry, sink)
        return due

    def _put_right(self, entry: tuple[int, int, Entity], sink: object) -> None:
        """Remove the outdated first entry, or move it to its timer's deadline."""
        deadline, order, timer = entry
        # An outdated entry: the timer has moved to another executor, or was pushed again with an earlier time.
        if timer.heap is not self or timer.heap_deadline != deadline:
            heappop(self.entries)
        elif timer.sink is not sink:
            heappop(self.entries)
            timer.heap = None
        elif timer.due_at > deadline:
            timer.heap_deadline = timer.due_at
            heapreplace(self.entries, (timer.due_at, order, timer))
