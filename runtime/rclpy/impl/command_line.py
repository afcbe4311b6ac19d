"""Command lines for a context and for a node, with rclpy's exceptions."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from bot_console.runtime.rmw import arguments
from rclpy._rclpy_pybind11 import RCLError, RCLInvalidROSArgsError, UnknownROSArgsError


def parse_words(words: Sequence[str]) -> Any:
    """Parse a command line; raises `RCLError`."""
    try:
        return arguments.parse(words)
    except arguments.ArgumentsError as error:
        raise RCLError(f"failed to initialize rcl: {error}") from None


def parse_global(words: Sequence[str]) -> Any:
    """The arguments of a context; raises `RCLError` after a log line of rcl's, `UnknownROSArgsError` for strange flags."""
    from rclpy.logging import get_logger

    try:
        parsed = arguments.parse(words)
    except arguments.ArgumentsError as error:
        get_logger("rcl").error("Failed to parse global arguments")
        raise RCLError(f"failed to initialize rcl: {error}") from None
    if parsed.unknown_ros_args:
        raise UnknownROSArgsError(repr(list(parsed.unknown_ros_args)))
    from rclpy.logging import apply_arguments

    apply_arguments(parsed)
    return parsed


def parse_local(words: Sequence[str]) -> Any:
    """The arguments of one node (`cli_args`); raises `RCLInvalidROSArgsError` and `UnknownROSArgsError`."""
    try:
        parsed = arguments.parse(words)
    except arguments.ArgumentsError as error:
        raise RCLInvalidROSArgsError(f"Failed to parse ROS arguments: {error}") from None
    if parsed.unknown_ros_args:
        raise UnknownROSArgsError(repr(list(parsed.unknown_ros_args)))
    return parsed
