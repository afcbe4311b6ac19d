"""Parses the command lines of a context and of a node, with rclpy's exceptions."""

from __future__ import annotations

import re
from collections.abc import Sequence

from bot_console.runtime.process.crashes import HINT
from bot_console.runtime.programs.hints import is_read
from bot_console.runtime.rmw import arguments, names
from bot_console.runtime.rmw.arguments import Arguments, ArgumentsError
from rclpy._rclpy_pybind11 import RCLError, RCLInvalidROSArgsError, UnknownROSArgsError
from rclpy.impl.log_file import LogFile
from rclpy.impl.log_routing import state
from rclpy.impl.rcutils_logger import RcutilsLogger

DEPRECATED = "Found remap rule '{0}'. This syntax is deprecated. Use '--ros-args --remap {0}' instead."
NOT_OBEYED = "'{0}' is outside of --ros-args and is left to the program. A parameter is set by --ros-args -p {0}"
"""Without the flag, rcl takes `-p speed:=2.5` for an ordinary word and says nothing about it."""
ASSIGNED = r"[A-Za-z_][\w./]*:=."
NO_LOG_CONFIG = "spdlog logging backend doesn't currently support external configuration"
"""Upstream's usual backend does not support a configuration file either, so a program that gives one does not start."""


def parse_global(words: Sequence[str]) -> Arguments:
    """Parse the arguments of a context; raises `RCLError` (rcl logs why), `UnknownROSArgsError` for unknown flags."""
    try:
        parsed = _parse(words)
    except ArgumentsError as error:
        RcutilsLogger("rcl").error("Failed to parse global arguments")
        refused = RCLError(f"failed to initialize rcl: {error}")
        if is_read():
            setattr(refused, HINT, error.hint)
        raise refused from None
    _refuse_enclave(parsed.enclave)
    _refuse_unknown(parsed)
    if parsed.log_config_file:
        raise RCLError(f"failed to initialize logging: {NO_LOG_CONFIG}")
    state().apply_arguments(parsed)
    if is_read():
        for word in (each for each in parsed.unparsed if re.match(ASSIGNED, each)):
            RcutilsLogger("rcl").warning(NOT_OBEYED.format(word))
    return parsed


def begin_log_file(parsed: Arguments) -> LogFile:
    """Choose the process's log file for a new context; raises `RCLError` if its folder cannot be created."""
    log_file = state().log_file
    try:
        log_file.begin(parsed)
    except OSError as error:
        reason = f"Failed to create log directory '{error.filename}': {error.errno}"
        raise RCLError(f"failed to initialize logging: {reason}") from None
    return log_file


def parse_words(words: Sequence[str]) -> Arguments:
    """Parse a command line, allowing unknown flags; raises `RCLInvalidROSArgsError`."""
    try:
        return _parse(words)
    except ArgumentsError as error:
        raise RCLInvalidROSArgsError(f"Failed to parse ROS arguments: {error}") from None


def parse_local(words: Sequence[str]) -> Arguments:
    """Parse the arguments of one node (`cli_args`); raises `RCLInvalidROSArgsError` and `UnknownROSArgsError`."""
    parsed = parse_words(words)
    _refuse_unknown(parsed)
    return parsed


def _parse(words: Sequence[str]) -> Arguments:
    try:
        parsed = arguments.parse(words)
    except ArgumentsError as error:
        if error.warning:
            RcutilsLogger("rcl").warning(error.warning)
        raise
    for rule in parsed.deprecated_rules:
        RcutilsLogger("rcl").warning(DEPRECATED.format(rule))
    return parsed


def _refuse_enclave(enclave: str | None) -> None:
    """Reject an invalid enclave of a context; that of a single node (`cli_args`) is ignored, as upstream."""
    problem = None if enclave is None else names.validate_enclave(enclave)
    if problem:
        words = f"Enclave name is not valid: '{problem[0]}'. Invalid index: {problem[1]}"
        raise RCLError(f"failed to initialize rcl: {words}")


def _refuse_unknown(parsed: Arguments) -> None:
    if parsed.unknown_ros_args:
        refused = UnknownROSArgsError(repr(parsed.unknown_ros_args))
        if is_read():
            setattr(refused, HINT, arguments.suggest_argument(parsed.unknown_ros_args[0]))
        raise refused
