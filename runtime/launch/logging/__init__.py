"""Logging of a launch: its own records and its processes' output, to the screen and to files."""

from __future__ import annotations

from launch.logging import handlers
from launch.logging.config import LaunchConfig, launch_config
from launch.logging.launch_logger import LaunchLogger, get_logger, reset_loggers
from launch.logging.log_directory import get_logging_directory
from launch.logging.process_output import get_output_loggers

_get_logging_directory = get_logging_directory


def reset() -> None:
    """Discard all settings, handlers and files."""
    reset_loggers()
    launch_config.reset()


__all__ = [
    "LaunchConfig",
    "LaunchLogger",
    "get_logger",
    "get_logging_directory",
    "get_output_loggers",
    "handlers",
    "launch_config",
    "reset",
]
