"""The wakeup of a waiting thread in a stepped run."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..node.thread_state import local
from .baton import Seat

if TYPE_CHECKING:
    from .baton import Baton


class SteppedWakeup:
    """Like `threading.Event`, for threads that hand the baton on while they wait."""

    __slots__ = ("__weakref__", "_baton", "flag", "waiters")

    def __init__(self, baton: Baton) -> None:
        self._baton = baton
        self.flag = False
        self.waiters: list[Seat] = []

    def set(self) -> None:
        """Wake the waiters; thread-safe."""
        if not self.flag:
            self._baton.rouse_all(self)

    def clear(self) -> None:
        """Undo an earlier `set`."""
        self.flag = False

    def is_set(self) -> bool:
        """Whether `set` was called since the last `clear`."""
        return self.flag

    def wait(self, deadline_ns: int | None = None) -> bool:
        """Hand the baton on until set or until virtual time reaches the deadline (ns); return whether it was set."""
        seat = local.seat
        if not isinstance(seat, Seat) or seat.baton is not self._baton:
            return self._baton.wait_outside(self, deadline_ns)
        return seat.wait(self, deadline_ns)
