"""`time.sleep`, `Condition.wait` and `queue.SimpleQueue` for node threads: signals end waits, stepped runs see them.

`threading.Event`, `Semaphore`, `Barrier`, `Timer`, `queue.Queue` and `concurrent.futures` all wait in a `Condition`.
"""

from __future__ import annotations

import queue
import threading
from collections import deque
from contextlib import suppress
from types import GenericAlias
from typing import TYPE_CHECKING, Any, SupportsIndex

from .. import unpatched
from ..node.thread_state import local

if TYPE_CHECKING:
    from ..clock_source import Wakeup

_condition_wait = threading.Condition.wait
_RealSimpleQueue: type[queue.SimpleQueue[Any]] = queue.SimpleQueue


def sleep(seconds: float, /) -> None:
    """`time.sleep` on the clock of the calling thread's node process."""
    clock = local.waits_on
    number = isinstance(seconds, (float, SupportsIndex))  # pyright: ignore[reportUnnecessaryIsInstance] -- node code
    if clock is None or not number or not 0 <= seconds < threading.TIMEOUT_MAX:
        unpatched.sleep(seconds)  # raises the interpreter's errors
        return
    clock.sleep_until(clock.steady_ns() + int(float(seconds) * 1e9))


class _Waiter:
    """An entry in a condition's waiters that replaces the lock: `notify` releases it."""

    __slots__ = ("wakeup",)

    def __init__(self, wakeup: Wakeup) -> None:
        self.wakeup = wakeup

    def release(self) -> None:
        self.wakeup.set()


def condition_wait(condition: Any, timeout: float | None = None) -> bool:
    """`threading.Condition.wait` on the clock of the calling thread's node process."""
    clock = local.waits_on
    if clock is None or (timeout is not None and timeout <= 0):  # a wait that does not block needs no turn
        return _condition_wait(condition, timeout)
    if not condition._is_owned():
        raise RuntimeError("cannot wait on un-acquired lock")
    deadline = None if timeout is None else clock.steady_ns() + int(timeout * 1e9)
    waiter = _Waiter(clock.wakeup())
    condition._waiters.append(waiter)
    saved = condition._release_save()
    notified = False
    try:
        notified = waiter.wakeup.wait(deadline)
        return notified
    finally:
        condition._acquire_restore(saved)
        if not notified:
            with suppress(ValueError):  # notified just now
                condition._waiters.remove(waiter)


class SimpleQueue:
    """`queue.SimpleQueue` based on a condition, because a thread that blocks in the built-in one cannot be woken."""

    def __new__(cls) -> Any:
        """Return a queue for the calling thread: the built-in one outside node processes."""
        return _RealSimpleQueue() if local.waits_on is None else super().__new__(cls)

    __class_getitem__: Any = classmethod(GenericAlias)  # pyright: ignore[reportUnknownVariableType] -- as typeshed has it

    def __init__(self) -> None:
        self._items: deque[Any] = deque()
        self._filled = threading.Condition()

    def put(self, item: Any, block: bool = True, timeout: float | None = None) -> None:
        """Append an item; never blocks."""
        with self._filled:
            self._items.append(item)
            self._filled.notify()

    put_nowait = put

    def get(self, block: bool = True, timeout: float | None = None) -> Any:
        """Take the oldest item. Raises `queue.Empty` if there is none, or none within `timeout` (s)."""
        if timeout is not None and timeout < 0:
            raise ValueError("'timeout' must be a non-negative number")
        with self._filled:
            if not self._filled.wait_for(self._items.__len__, timeout if block else 0.0):
                raise queue.Empty
            return self._items.popleft()

    def get_nowait(self) -> Any:
        """Take the oldest item. Raises `queue.Empty` if there is none."""
        return self.get(block=False)

    def empty(self) -> bool:
        """Whether the queue is empty now."""
        return not self._items

    def qsize(self) -> int:
        """Return the present number of items."""
        return len(self._items)
