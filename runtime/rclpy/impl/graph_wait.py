"""Waiting for something to appear in the graph."""

# pyright: reportPrivateUsage=false
# The modules of rclpy are one library: what its users are not to touch has an underscore, as upstream.

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Protocol

from bot_console.runtime.process import current
from bot_console.runtime.rmw.endpoints import Owner
from rclpy._rclpy_pybind11 import RCLError
from rclpy.constants import S_TO_NS

if TYPE_CHECKING:
    from bot_console.runtime.rmw.bus import Bus


class ContextState(Protocol):
    """A context that may have ended."""

    @property
    def ended(self) -> bool:
        """Whether it was shut down."""
        ...

    def ok(self) -> bool:
        """Whether it is valid; raises a pending interrupt."""
        ...


class NodeInGraph(Protocol):
    """A node as far as waiting for the graph needs it."""

    @property
    def _ros_bus(self) -> Bus: ...

    @property
    def context(self) -> ContextState:
        """The context that the node belongs to."""
        ...


POLL = S_TO_NS // 4


def require_valid(context: ContextState, what: str) -> None:
    """Raise `RCLError` if the context was shut down, as the graph is unknown then.

    This ends loops that poll for an endpoint, which would never end otherwise.
    """
    if context.ended and not context.ok():  # ok() raises a pending interrupt first
        raise RCLError(f"{what}: rcl node's context is invalid")


def wait_until_there(node: NodeInGraph, is_there: Callable[[], bool], timeout_sec: float | None) -> bool:
    """Block until `is_there()`, a time-out (s) or the context's shutdown; returns the last `is_there()`."""
    clock = current().clock
    deadline = None if timeout_sec is None else clock.steady_ns() + int(timeout_sec * float(S_TO_NS))
    wakeup = clock.wakeup()

    def woken(owner: Owner) -> None:
        wakeup.set()

    forget = node._ros_bus.on_graph_change(woken)
    try:
        while node.context.ok() and not is_there():
            now = clock.steady_ns()
            if deadline is not None and now >= deadline:
                break
            # Changes of the graph wake this up; the poll notices a shutdown of the context.
            until = now + POLL
            wakeup.wait(until if deadline is None else min(until, deadline))
            wakeup.clear()
    finally:
        forget()
    return is_there()
