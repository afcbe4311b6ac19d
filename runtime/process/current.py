"""The node process of the calling thread, and variables with a value per node process."""

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
"""The real process, to which every thread belongs that was not started by a node process."""

type(local).process = MAIN


def current() -> CurrentProcess:
    """Return the node process of the calling thread."""
    return local.process


@contextmanager
def running_as(process: CurrentProcess) -> Generator[None]:
    """Run the block as part of a node process: with its `current()`, output, arguments and environment."""
    before = local.process
    local.process = process
    try:
        yield
    finally:
        local.process = before


class ProcessLocal(Generic[T]):
    """A variable with a separate value per node process, created on first use.

    _default_context = ProcessLocal(Context)
    _default_context.get()
    """

    def __init__(self, factory: Callable[[], T]) -> None:
        self._factory = factory

    def get(self) -> T:
        """Return the value in the calling thread's node process."""
        values = local.process.locals
        try:
            return values[self]
        except KeyError:
            return values.setdefault(self, self._factory())

    def set(self, value: T) -> None:
        """Replace the value in the calling thread's node process."""
        local.process.locals[self] = value
