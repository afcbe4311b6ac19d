"""Explains mistakes that end a node with an exception whose message does not tell the cause."""

from __future__ import annotations

import linecache
import re
from collections.abc import Callable
from typing import Any

from bot_console.runtime.terse import is_read
from rclpy.impl.written_values import value_text, written

WRONG_PARAMETER = (
    "Parameter is imported from rcl_interfaces.msg here, where it is the message class: it has no Parameter.Type and "
    "takes no positional arguments. Import the class of rclpy instead: from rclpy.parameter import Parameter"
)
NO_RESULT = (
    "A callback of add_on_set_parameters_callback returned nothing. It must return a SetParametersResult on every "
    "path: end it with  return SetParametersResult(successful=True)"
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


def _no_result(exception: BaseException) -> bool:
    return isinstance(exception, AttributeError) and exception.obj is None and exception.name == "successful"


def _wrong_type(exception: Any) -> str:
    """How to write a value of the declared type; only on a terminal, as rclpy has its own message."""
    # By name, as this module is below the public ones.
    if type(exception).__name__ != "InvalidParameterTypeException" or not is_read():
        return ""
    found = _EXPECTED.search(str(exception.args[0]))
    given = exception.param
    return written(given.name, value_text(given.value), found[1], given.type_.name) if found else ""


_KNOWN: tuple[tuple[Callable[[BaseException], bool], str], ...] = (
    (_wrong_parameter, WRONG_PARAMETER),
    (_no_result, NO_RESULT),
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
