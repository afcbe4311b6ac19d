"""The logging module for programs: loggers by name, levels, and the publishers of `/rosout` behind them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy.impl.log_routing import forget_rosout, logging_directory, state
from rclpy.impl.log_routing import reset as _reset
from rclpy.impl.logging_severity import LoggingSeverity as LoggingSeverity
from rclpy.impl.rcutils_logger import RcutilsLogger

if TYPE_CHECKING:
    from pathlib import Path

_root_logger = RcutilsLogger()
_REGISTERED_TWICE = (
    "Publisher already registered for node name: '{0}'. If this is due to multiple nodes with the same name then all "
    "logs for the logger named '{0}' will go out over the existing publisher. As soon as any node with that name is "
    "destructed it will unregister the publisher, preventing any further logs for that name from being published on "
    "the rosout topic."
)


def get_logger(name: str) -> RcutilsLogger:
    """Return the logger with that name; raises `ValueError` for an empty one."""
    if not name:
        raise ValueError("Logger name must not be empty.")
    return RcutilsLogger(name)


def initialize() -> None:
    """Read the environment again."""
    _reset()


def shutdown() -> None:
    """Reset levels and formats."""
    _reset()


def clear_config() -> None:
    """Reset levels."""
    _reset()


def set_logger_level(name: str, level: LoggingSeverity | int, detailed_error: bool = False) -> Any:
    """Set a logger's level; raises `ValueError` for an invalid one, whatever `detailed_error` is."""
    state().set_level(name, LoggingSeverity(level))


def get_logger_level(name: str) -> LoggingSeverity:
    """Return the level set for exactly that logger, or UNSET."""
    shared = state()
    return LoggingSeverity(shared.levels.get(name, 0) if name else shared.default)


def get_logger_effective_level(name: str) -> LoggingSeverity:
    """Return the level of the nearest ancestor that has one, or the default."""
    return LoggingSeverity(state().effective_level(name))


def get_logging_severity_from_string(log_severity: str) -> LoggingSeverity:
    """Return the severity with that name, in upper or lower case; raises `RuntimeError` if there is none."""
    try:
        return LoggingSeverity[log_severity.upper()]
    except (KeyError, AttributeError):  # AttributeError: not a string
        raise RuntimeError("Failed to get severity name") from None


def get_logging_directory() -> Path:
    """Return the folder for log files."""
    from pathlib import Path

    return Path(logging_directory())


def register_rosout(name: str, publish: Any) -> None:
    """Publish the messages of the logger with that name through a node's publisher."""
    shared = state()
    if name in shared.rosout:
        get_logger("rcl.logging_rosout").warning(_REGISTERED_TWICE.format(name))
        return
    shared.rosout[name] = publish


def unregister_rosout(name: str) -> None:
    """Stop publishing the messages of the logger with that name and of its children."""
    shared = state()
    publish = shared.rosout.get(name)
    if publish is not None:
        forget_rosout(shared, publish)
