"""Waiting for something to appear in the graph."""

# pyright: reportPrivateUsage=false
# The modules of rclpy are one library: what its users are not to touch has an underscore, as upstream.

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from bot_console.runtime.process import current
from bot_console.runtime.rmw.endpoints import Owner
from rclpy._rclpy_pybind11 import RCLError

NANO = 1_000_000_000
POLL = NANO // 4


def require_valid(context: Any, what: str) -> None:
    """Raise `RCLError` where the context was shut down: nobody can say then who is there.

    A loop that asks until somebody is there ends by that, instead of going on for ever.
    """
    if context.ended and not context.ok():  # ok() lets a pending interrupt come first
        raise RCLError(f"{what}: rcl node's context is invalid")


def wait_until_there(node: Any, is_there: Callable[[], bool], timeout_sec: float | None) -> bool:
    """Block until somebody is there, the time (s) is over or the context was shut down; gives what `is_there` says."""
    clock = current().clock
    deadline = None if timeout_sec is None else clock.steady_ns() + int(timeout_sec * NANO)
    wakeup = clock.wakeup()

    def woken(owner: Owner) -> None:
        wakeup.set()

    forget = node._ros_bus.on_graph_change(woken)
    try:
        while node.context.ok() and not is_there():
            now = clock.steady_ns()
            if deadline is not None and now >= deadline:
                break
            # The graph wakes this up; the poll is for a shutdown of the context.
            until = now + POLL
            wakeup.wait(until if deadline is None else min(until, deadline))
            wakeup.clear()
    finally:
        forget()
    return is_there()
