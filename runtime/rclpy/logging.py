"""Logging as programs use it: loggers by name, levels, and the publishers of `/rosout` behind them."""

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
    """A logger of that name; raises `ValueError` for an empty one."""
    if not name:
        raise ValueError("Logger name must not be empty.")
    return RcutilsLogger(name)


def initialize() -> None:
    """Read the environment again."""
    _reset()


def shutdown() -> None:
    """Forget levels and formats."""
    _reset()


def clear_config() -> None:
    """Forget levels."""
    _reset()


def set_logger_level(name: str, level: LoggingSeverity | int, detailed_error: bool = False) -> Any:
    """Set a logger's level; with `detailed_error` raises `RuntimeError` for a bad one, and nothing is returned."""
    state().set_level(name, LoggingSeverity(level))


def get_logger_level(name: str) -> LoggingSeverity:
    """The level set for exactly that logger, UNSET where there is none."""
    shared = state()
    return LoggingSeverity(shared.levels.get(name, 0) if name else shared.default)


def get_logger_effective_level(name: str) -> LoggingSeverity:
    """The level of the nearest ancestor that has one, else the default."""
    return LoggingSeverity(state().effective_level(name))


def get_logging_severity_from_string(log_severity: str) -> LoggingSeverity:
    """The severity of a name in any case; raises `RuntimeError`."""
    try:
        return LoggingSeverity[log_severity.upper()]
    except KeyError:
        raise RuntimeError("Failed to get severity name") from None


def get_logging_directory() -> Path:
    """Where log files lie."""
    from pathlib import Path

    return Path(logging_directory())


def register_rosout(name: str, say: Any) -> None:
    """Let a node's publisher carry what the logger of that name says."""
    shared = state()
    if name in shared.rosout:
        get_logger("rcl.logging_rosout").warning(_REGISTERED_TWICE.format(name))
        return
    shared.rosout[name] = say


def unregister_rosout(name: str) -> None:
    """Let the logger of that name, and its children, go to the console only."""
    shared = state()
    say = shared.rosout.get(name)
    if say is not None:
        forget_rosout(shared, say)
