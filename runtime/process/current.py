"""Which node process the calling thread belongs to, and state that each node process has for itself."""

from __future__ import annotations

from collections.abc import Callable, Generator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Generic, TypeVar

from .node.main_process import MainProcess
from .node.node_process import NodeProcess
from .node.thread_state import local

if TYPE_CHECKING:
    from .roles import CurrentProcess

__all__ = ["MAIN", "NodeProcess", "ProcessLocal", "current", "running_as"]

T = TypeVar("T")

MAIN = MainProcess("main")
"""The real process: what every thread belongs to that no node process has started."""

type(local).process = MAIN


def current() -> CurrentProcess:
    """The node process of the calling thread."""
    return local.process


@contextmanager
def running_as(process: CurrentProcess) -> Generator[None]:
    """Let the calling thread work for a node process for a while: its `current()`, output, arguments, environment."""
    before = local.process
    local.process = process
    try:
        yield
    finally:
        local.process = before


class ProcessLocal(Generic[T]):
    """A variable that each node process has for itself, made at first use.

    _default_context = ProcessLocal(Context)
    _default_context.get()
    """

    def __init__(self, factory: Callable[[], T]) -> None:
        self._factory = factory

    def get(self) -> T:
        """The calling thread's node process's value."""
        values = local.process.locals
        try:
            return values[self]
        except KeyError:
            return values.setdefault(self, self._factory())

    def set(self, value: T) -> None:
        """Replace the value in the calling thread's node process."""
        local.process.locals[self] = value
