"""Waiting for something to appear in the graph."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

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
    """What a wait needs of a context, which may be shut down."""

    @property
    def ended(self) -> bool:
        """Whether the context was shut down."""
        ...

    def ok(self) -> bool:
        """Whether the context is valid; raises a pending interrupt."""
        ...


class NodeInGraph(Protocol):
    """What a wait for the graph needs of a node."""

    @property
    def _ros_bus(self) -> Bus: ...

    @property
    def context(self) -> ContextState:
        """The context that the node belongs to."""
        ...


POLL = S_TO_NS // 4


def require_valid(context: ContextState, what: str) -> None:
    """Raise `RCLError` if the context was shut down, as the graph is then unknown.

    This ends loops that poll for an endpoint and would otherwise never end.
    """
    if context.ended and not context.ok():  # ok() raises a pending interrupt first
        raise RCLError(f"{what}: rcl node's context is invalid")


def wait_until_there(node: NodeInGraph, is_there: Callable[[], bool], timeout_sec: float | None) -> bool:
    """Block until `is_there()` is true, a time-out (s) or the context's shutdown; returns the last `is_there()`."""
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
            # Changes of the graph end this wait early; the polling notices a shutdown of the context.
            until = now + POLL
            wakeup.wait(until if deadline is None else min(until, deadline))
            wakeup.clear()
    finally:
        forget()
    return is_there()
