"""Clock sources and how a thread waits on them: the interface that makes stepped runs possible.

Protocols only: `real_time` and `stepping.stepped_time` are the two sources, `node.thread_state` is what they wake.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol


class WaitingThread(Protocol):
    """A thread of a node process, as its clock source sees it."""

    @property
    def called(self) -> bool:
        """Whether anything is pending to be raised or run in this thread."""
        ...

    def begin_wait(self, waker: Callable[[], None]) -> None:
        """Register how to wake the thread from the wait it is entering; raises any pending exception."""
        ...

    def end_wait(self) -> None:
        """End the wait."""
        ...

    def deliver(self) -> None:
        """Run, in this thread, the pending actions; raises what they raise."""
        ...


class TurnTaker(Protocol):
    """A thread's place in a stepped run."""

    detached: bool
    """Whether the thread was considered hung, so that other threads run beside it."""

    def take(self) -> None:
        """Wait for the first turn; called in the thread that this task represents."""
        ...

    def hold_clock(self) -> None:
        """Stop the clock until this thread first waits, or ends."""
        ...

    def attach(self) -> None:
        """Let this thread, which was considered hung, run until it waits; called by the thread that has the turn."""
        ...

    def leave(self) -> None:
        """Take no more turns."""
        ...


class Wakeup(Protocol):
    """An event that a thread of a node process waits for: like `threading.Event`, with deadlines in steady time."""

    def set(self) -> None:
        """Wake the waiter; may be called from any thread at any time."""
        ...

    def clear(self) -> None:
        """Undo an earlier `set`."""
        ...

    def is_set(self) -> bool:
        """Whether `set` was called since the last `clear`."""
        ...

    def wait(self, deadline_ns: int | None = None) -> bool:
        """Block until set or until steady time reaches the deadline (ns); return whether it is set.

        Raises `KeyboardInterrupt` if the node process is interrupted meanwhile.
        """
        ...


class ClockSource(Protocol):
    """Steady and system time of a run. All blocking in the runtime goes through `wakeup()` and `sleep_until`."""

    stepped: bool
    """Whether time is virtual."""

    def steady_ns(self) -> int:
        """Monotonic time in ns."""
        ...

    def system_ns(self) -> int:
        """Time since the Unix epoch in ns."""
        ...

    def wakeup(self) -> Wakeup:
        """Return a new, unset wakeup of this clock source."""
        ...

    def sleep_until(self, deadline_ns: int) -> None:
        """Block until steady time reaches the deadline (ns)."""
        ...

    def task(self, thread: WaitingThread) -> TurnTaker | None:
        """Return a task for a new thread of a node process; None if threads do not take turns."""
        ...
