"""The wakeup of a waiting thread in a stepped run."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..node.thread_state import local
from .scheduler import ScheduledTask

if TYPE_CHECKING:
    from .scheduler import Scheduler


class SteppedWakeup:
    """Like `threading.Event`, for threads that pass the turn on while they wait."""

    __slots__ = ("__weakref__", "_scheduler", "flag", "waiters")

    def __init__(self, scheduler: Scheduler) -> None:
        self._scheduler = scheduler
        self.flag = False
        self.waiters: list[ScheduledTask] = []

    def set(self) -> None:
        """Wake the waiters; thread-safe."""
        if not self.flag:
            self._scheduler.wake_all_threads(self)

    def clear(self) -> None:
        """Undo an earlier `set`."""
        self.flag = False

    def is_set(self) -> bool:
        """Whether `set` was called since the last `clear`."""
        return self.flag

    def wait(self, deadline_ns: int | None = None) -> bool:
        """Pass the turn on until set or until virtual time reaches the deadline (ns); return whether it was set."""
        task = local.task
        if not isinstance(task, ScheduledTask) or task.scheduler is not self._scheduler:
            return self._scheduler.wait_outside(self, deadline_ns)
        return task.wait(self, deadline_ns)
