"""Utilities for the modules of rclpy and for programs: the default context, and queries of command lines."""

from __future__ import annotations

import sys
import threading
from collections.abc import Sequence

from bot_console.runtime.process import ProcessLocal
from bot_console.runtime.rmw.middleware import qos_rules
from rclpy.constants import S_TO_NS
from rclpy.context import Context
from rclpy.impl.reexports import reexporting

_default_context: ProcessLocal[list[Context]] = ProcessLocal(list)
"""A process's default context; empty before its first use and after its shutdown."""
_lock = threading.Lock()


def get_default_context(*, shutting_down: bool = False) -> Context:
    """Return the default context; with `shutting_down`, the next call creates a new one."""
    with _lock:
        holder = _default_context.get()
        if not holder:
            holder.append(Context())
        return holder.pop() if shutting_down else holder[0]


def remove_ros_args(args: Sequence[str] | None = None) -> list[str]:
    """Return the arguments without those for ROS; the program's name is kept.

    Raises `RCLInvalidROSArgsError` for invalid rules, `UnknownROSArgsError` for unknown ROS arguments.
    """
    from rclpy.impl.command_line import parse_local

    return parse_local(sys.argv if args is None else args).unparsed


def ok(*, context: Context | None = None) -> bool:
    """Whether ROS is initialised and not shut down."""
    return (get_default_context() if context is None else context).ok()


def shutdown(*, context: Context | None = None) -> None:
    """Shut a context down; raises `RuntimeError` before `init`, `RCLError` if a signal has done so already."""
    (get_default_context(shutting_down=True) if context is None else context).shutdown()


def try_shutdown(*, context: Context | None = None) -> None:
    """Shut a context down, unless it is already shut down."""
    (get_default_context(shutting_down=True) if context is None else context).try_shutdown()


def get_rmw_implementation_identifier() -> str:
    """Return the name of the middleware."""
    return qos_rules().identifier


def get_available_rmw_implementations() -> set[str]:
    """Return the names of the available middlewares."""
    return {get_rmw_implementation_identifier()}


def timeout_sec_to_nsec(timeout_sec: float | None) -> int:
    """Return a time-out in ns; -1 (for ever) for None and negative values."""
    if timeout_sec is None or timeout_sec < 0:
        return -1
    return int(float(timeout_sec) * S_TO_NS)


__getattr__ = reexporting(__name__, "Context")
