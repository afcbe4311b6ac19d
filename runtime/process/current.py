"""Which node process the calling thread belongs to, and state that each node process has for itself."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any, Generic, TypeVar

from bot_console.runtime.process.clock_source import ClockSource, RealTime

T = TypeVar("T")


class NodeProcess:
    """A process as its code sees it: a name, a clock source, and the state of `ProcessLocal`s."""

    def __init__(self, name: str, clock: ClockSource | None = None) -> None:
        self.name = name
        self.clock: ClockSource = clock or RealTime()
        self.locals: dict[Any, Any] = {}


MAIN = NodeProcess("main")
"""The real process: what every thread belongs to that no node process has started."""

_thread = threading.local()


def current() -> NodeProcess:
    """The node process of the calling thread."""
    return getattr(_thread, "process", MAIN)


class ProcessLocal(Generic[T]):
    """A variable that each node process has for itself, made at first use.

    _default_context = ProcessLocal(Context)
    _default_context.get()
    """

    def __init__(self, factory: Callable[[], T]) -> None:
        self._factory = factory

    def get(self) -> T:
        """The calling thread's node process's value."""
        values = current().locals
        try:
            return values[self]
        except KeyError:
            return values.setdefault(self, self._factory())

    def set(self, value: T) -> None:
        """Replace the value in the calling thread's node process."""
        current().locals[self] = value
