"""Explains mistakes that end a node with an exception whose message does not tell the cause."""

from __future__ import annotations

import linecache
import re
import sys
from collections.abc import Callable
from typing import Any

from bot_console.runtime.exit_messages import is_read
from bot_console.runtime.process import current
from bot_console.runtime.process.frames import line_outside
from bot_console.runtime.process.notices import notify
from rclpy.impl.callables import is_coroutine
from rclpy.impl.written_values import literal_text, written

WRONG_PARAMETER = (
    "Parameter is imported from rcl_interfaces.msg here, where it is the message class: it has no Parameter.Type and "
    "takes no positional arguments. Import the class of rclpy instead: from rclpy.parameter import Parameter"
)
INVALID_RESULT = (
    "the callback of add_on_set_parameters_callback returned {}, so the parameters were not set. It must return a "
    "SetParametersResult on every path: end it with  return SetParametersResult(successful=True)"
)
COROUTINE_RESULT = (
    "the callback of add_on_set_parameters_callback is an async function, whose result is not awaited, so the "
    "parameters were not set. Use a plain function: def, without async"
)
INIT_IN_WITH = (
    "rclpy.init() returns nothing in ROS 2 Jazzy; only later releases support `with rclpy.init():`. Call rclpy.init() "
    "on a line of its own, and rclpy.try_shutdown() at the end"
)

SPUN_TWICE = (
    "a second thread spins an executor that one already spins; rclpy.spin() has one executor for all nodes of the "
    "program. Spin in one thread only, or give each thread an executor of its own: rclpy.spin(node, executor)"
)

_EXPECTED = re.compile(r"expecting type '(\w+)'")


def explain(exception: BaseException) -> str | None:
    """The cause and remedy of a known mistake, with file and line; None for all others."""
    for is_it, text in _KNOWN:
        if is_it(exception):
            return f"{_users_line(exception)}{text}"
    if text := _wrong_type(exception):
        return f"{_users_line(exception)}{text}"
    return None


def _wrong_parameter(exception: BaseException) -> bool:
    if isinstance(exception, AttributeError):
        owner = exception.obj
        return isinstance(owner, type) and _is_message(owner) and exception.name == "Type"
    return isinstance(exception, TypeError) and str(exception).startswith("Parameter.__init__() takes 1 positional")


def _is_message(owner: type) -> bool:
    return owner.__name__ == "Parameter" and owner.__module__.startswith("rcl_interfaces.")


def _init_in_with(exception: BaseException) -> bool:
    """Whether `with rclpy.init():` failed; Python 3.10 words its error differently."""
    text = str(exception)
    if not isinstance(exception, (TypeError, AttributeError)) or not ("__enter__" in text or "context manager" in text):
        return False
    trace = exception.__traceback__
    while trace is not None and trace.tb_next is not None:
        trace = trace.tb_next
    line = "" if trace is None else linecache.getline(trace.tb_frame.f_code.co_filename, trace.tb_lineno)
    return re.match(r"\s*(async )?with\b.*\binit\(", line) is not None


def spun_twice() -> ValueError:
    """The error of two threads that wait for work of one executor; a person is also told how to avoid it."""
    if is_read():
        frame = sys._getframe(1)  # pyright: ignore[reportPrivateUsage] -- documented in `sys`
        notify(current(), f"{line_outside(frame)}: {SPUN_TWICE}")
    return ValueError("generator already executing")


def invalid_result(callback: Callable[..., Any], result: object) -> str:
    """What a parameter callback should have returned, with its file and line; empty where no person reads it."""
    if not is_read():
        return ""
    code = getattr(callback, "__code__", None)
    place = f"{code.co_filename}:{code.co_firstlineno}: " if code else ""
    if is_coroutine(result):
        return place + COROUTINE_RESULT
    return place + INVALID_RESULT.format("nothing" if result is None else f"a {type(result).__name__}")


def _wrong_type(exception: Any) -> str:
    """How to write a value of the declared type; only on a terminal, as rclpy has its own message."""
    # By name, as this module is below the public ones.
    if type(exception).__name__ != "InvalidParameterTypeException" or not is_read():
        return ""
    found = _EXPECTED.search(str(exception.args[0]))
    given = exception.param
    return written(given.name, literal_text(given.value), found[1], given.type_.name) if found else ""


_KNOWN: tuple[tuple[Callable[[BaseException], bool], str], ...] = (
    (_wrong_parameter, WRONG_PARAMETER),
    (_init_in_with, INIT_IN_WITH),
)


def _users_line(exception: BaseException) -> str:
    """`file.py:12: ` for the innermost frame outside the runtime; empty without one."""
    found = ""
    trace = exception.__traceback__
    while trace is not None:
        name = trace.tb_frame.f_code.co_filename
        module = str(trace.tb_frame.f_globals.get("__name__", ""))
        if module.partition(".")[0] not in ("rclpy", "bot_console") and linecache.getline(name, trace.tb_lineno):
            found = f"{name}:{trace.tb_lineno}: "
        trace = trace.tb_next
    return found
