"""Where all time comes from, and how a thread waits: the interface that makes a stepped run possible.

Protocols only: `real_time` and `stepping.stepped_time` are the two sources, `node.thread_state` is what they wake.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol


class WaitingThread(Protocol):
    """A thread of a node process, as its clock source sees it."""

    @property
    def called(self) -> bool:
        """Whether something waits to be raised or run in this thread."""
        ...

    def begin_wait(self, waker: Callable[[], None]) -> None:
        """Say how to wake the thread from the wait it now enters; raises what is to be raised in it."""
        ...

    def end_wait(self) -> None:
        """The wait is over."""
        ...

    def deliver(self) -> None:
        """Run, in this thread, what waits for that; raises what it raises."""
        ...


class Seat(Protocol):
    """A thread's place in a stepped run, as the thread sees it."""

    detached: bool
    """Whether it was taken for hanging, and others go on beside it."""

    def take(self) -> None:
        """Wait for the first turn, in the thread that has this place from now on."""
        ...

    def hold_clock(self) -> None:
        """Let time stand still until the first wait, or the end, of this thread."""
        ...

    def leave(self) -> None:
        """Take no more turns."""
        ...


class Wakeup(Protocol):
    """What a thread of a node process waits on: as `threading.Event`, with deadlines of steady time."""

    def set(self) -> None:
        """Wake the waiter; from any thread, at any time."""
        ...

    def clear(self) -> None:
        """Forget an earlier `set`."""
        ...

    def is_set(self) -> bool:
        """Whether `set` was called since the last `clear`."""
        ...

    def wait(self, deadline_ns: int | None = None) -> bool:
        """Block until set or until steady time reaches the deadline (ns); whether it is set.

        Raises `KeyboardInterrupt` when the node process is interrupted meanwhile.
        """
        ...


class ClockSource(Protocol):
    """Steady and system time of one run. All blocking in the runtime goes through `wakeup()` and `sleep_until`."""

    stepped: bool
    """Whether time is virtual."""

    def steady_ns(self) -> int:
        """Monotonic time in ns."""
        ...

    def system_ns(self) -> int:
        """Time since the Unix epoch in ns."""
        ...

    def wakeup(self) -> Wakeup:
        """A new, unset wakeup of this clock source."""
        ...

    def sleep_until(self, deadline_ns: int) -> None:
        """Block until steady time reaches the deadline (ns)."""
        ...

    def seat(self, thread: WaitingThread) -> Seat | None:
        """A place for a new thread of a node process; None where threads run as they like."""
        ...
