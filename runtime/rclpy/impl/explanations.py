"""Explains mistakes that end a node with an exception whose message does not reveal the cause."""

from __future__ import annotations

import linecache
import re
import sys
from collections.abc import Callable
from typing import Any

from bot_console.runtime.process import current
from bot_console.runtime.process.notices import notify
from bot_console.runtime.process.stack_frames import is_shipped, line_outside
from bot_console.runtime.programs.hints import at, is_read, read_before_declared, wrong_type
from bot_console.runtime.rmw.parameter_places import place_of
from bot_console.runtime.rosidl.conversion import FieldTypeError
from rclpy.impl.callables import is_coroutine

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

GIVEN_BY = "_ros_given_by"
"""Attribute of an exception about an overridden value: its source, the node's full name, and the parameter."""
DECLARED = "_ros_declared"
"""Attribute of an exception about an undeclared parameter: the names the node has declared."""

_EXPECTED = re.compile(r"expecting type '(\w+)'")


def explain(exception: BaseException) -> str | None:
    """Return the cause and remedy of a known mistake, with file and line; None for any other exception."""
    for is_it, text in _KNOWN:
        if is_it(exception):
            return f"{_users_line(exception)}{text}"
    if text := _integer_in_range(exception):
        return text
    text = _wrong_type(exception) or _refused_value(exception) or _not_declared(exception)
    if not text:
        return None
    place = _place_of_value(exception)
    return at(place, text) if place else f"{_users_line(exception)}{text}"


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
    """Return the error for two threads that wait for work of one executor; a notice for people says how to avoid it."""
    if is_read():
        frame = sys._getframe(1)  # pyright: ignore[reportPrivateUsage] -- documented in `sys`
        notify(current(), f"{line_outside(frame)}: {SPUN_TWICE}")
    return ValueError("generator already executing")


def invalid_result(callback: Callable[..., object], result: object) -> str:
    """Return what a parameter callback should have returned, with its file and line; empty unless a person reads it."""
    if not is_read():
        return ""
    code = getattr(callback, "__code__", None)
    place = f"{code.co_filename}:{code.co_firstlineno}: " if code else ""
    if is_coroutine(result):
        return place + COROUTINE_RESULT
    return place + INVALID_RESULT.format("nothing" if result is None else f"a {type(result).__name__}")


def _wrong_type(exception: Any) -> str:
    """Return how to write a value of the declared type; only if a person reads it, as rclpy has its own message."""
    # Compared by name, as this module is below the public ones.
    if type(exception).__name__ != "InvalidParameterTypeException" or not is_read():
        return ""
    found = _EXPECTED.search(str(exception.args[0]))
    given = exception.param
    return wrong_type(given.name, _in_yaml(given.value), found[1], given.type_.name) if found else ""


def _integer_in_range(exception: object) -> str:
    """Return how to write a bound of a range; it is noticed only when somebody asks for the parameter's description."""
    if not isinstance(exception, FieldTypeError) or not is_read():
        return ""
    found = re.fullmatch(r"descriptors\[\d+\]\.floating_point_range\[\d+\]\.(\w+)", exception.field)
    bound, value = found[1] if found else "", exception.value
    if not bound or type(value) is not int or abs(value) >= 10**15:
        return ""
    return f"{bound}={value} in a FloatingPointRange of this node is an integer: write {bound}={value}.0"


def _refused_value(exception: object) -> str:
    """Return that the node refuses a value that came from a file, which the exception does not mention."""
    if type(exception).__name__ != "InvalidParameterValueException" or not is_read():
        return ""
    return "the node refuses this value" if _place_of_value(exception) else ""


def _not_declared(exception: Any) -> str:
    """Return the name of a parameter that was used without being declared, or how to declare it."""
    if type(exception).__name__ != "ParameterNotDeclaredException" or not is_read():
        return ""
    declared = getattr(exception, DECLARED, None)
    names = str(exception.args[0]).rpartition(": ")[2]
    name = next(iter(re.findall(r"[^\s\[\]',]+", names)), "")
    return read_before_declared(name, declared) if name and declared is not None else ""


def _place_of_value(exception: object) -> str:
    """Return the file and line that gave the refused value; empty if it did not come from a file."""
    source, node, name = getattr(exception, GIVEN_BY, ("", "", ""))
    return place_of(source, node, name)


_KNOWN: tuple[tuple[Callable[[BaseException], bool], str], ...] = (
    (_wrong_parameter, WRONG_PARAMETER),
    (_init_in_with, INIT_IN_WITH),
)


def _users_line(exception: BaseException) -> str:
    """Return `file.py:12: ` for the innermost frame outside the runtime and its own nodes; empty if there is none."""
    found = ""
    trace = exception.__traceback__
    while trace is not None:
        name = trace.tb_frame.f_code.co_filename
        module = str(trace.tb_frame.f_globals.get("__name__", ""))
        ours = module.partition(".")[0] in ("rclpy", "bot_console") or is_shipped(name)
        if not ours and linecache.getline(name, trace.tb_lineno):
            found = f"{name}:{trace.tb_lineno}: "
        trace = trace.tb_next
    return found


def _in_yaml(value: object) -> str:
    """Return a parameter's value as written in YAML."""
    return str(value).lower() if isinstance(value, bool) else str(value)
