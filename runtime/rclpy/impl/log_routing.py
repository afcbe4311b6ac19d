"""State shared by the loggers of a process: levels and destinations."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import TYPE_CHECKING

from bot_console.runtime.process import ProcessLocal
from rclpy.impl.log_file import LogFile
from rclpy.impl.log_format import Formatter

if TYPE_CHECKING:
    from bot_console.runtime.rmw.arguments import Arguments

UNSET = 0
INFO = 20

LogLine = Callable[[int, str, str, str, str, int, int], bool]
"""Receives severity, logger, text, file, function, line and time (ns); returns whether the message was published."""


class LogState:
    """Levels by logger name, the console's format, the log file, and the publishers of `/rosout`."""

    def __init__(self, log_file: LogFile | None = None) -> None:
        self.levels: dict[str, int] = {}
        self.effective: dict[str, int] = {}
        """Levels found by looking up ancestors; cleared when a level changes."""
        self.default = INFO
        self.stdout = True
        self.rosout: dict[str, LogLine] = {}
        self.formatter = Formatter.of_environment()
        self.log_file = log_file or LogFile()

    def set_level(self, name: str, level: int) -> None:
        """Set a logger's own level; an empty name means the default."""
        if name:
            self.levels[name] = level
        else:
            self.default = level
        self.effective.clear()

    def apply_arguments(self, arguments: Arguments) -> None:
        """Apply the log levels and switches of a context's command line."""
        for name, level in arguments.logger_levels.items():
            self.set_level(name, level)
        if arguments.default_level is not None:
            self.set_level("", arguments.default_level)
        self.stdout = arguments.stdout_enabled

    def effective_level(self, name: str) -> int:
        """Return the level of the nearest ancestor that has one, or the default."""
        found = self.effective.get(name)
        if found is None:
            found = self.effective[name] = self._find(name)
        return found

    def _find(self, name: str) -> int:
        while name:
            level = self.levels.get(name, UNSET)
            if level:
                return level
            name = name.rpartition(".")[0]
        return self.default or INFO

    def write(self, severity: int, name: str, text: str, file: str, function: str, line: int, stamp_ns: int) -> None:
        """Write a message to `/rosout`, the console and the log file."""
        publish = self.rosout.get(name)
        # `/rosout` comes first, because the formatted line can say whether the message was published there.
        sent = publish is not None and publish(severity, name, text, file, function, line, stamp_ns)
        if self.stdout:
            self.formatter.write(severity, name, text, file, function, line, stamp_ns, sent)
        if self.log_file.is_wanted:
            self.log_file.write(severity, name, text, file, function, line, stamp_ns, sent)


_state: ProcessLocal[LogState] = ProcessLocal(LogState)
state = _state.get


def logging_directory() -> str:
    """Return the folder for log files: `ROS_LOG_DIR`, else `log` in `ROS_HOME`, else `~/.ros/log`."""
    given = os.environ.get("ROS_LOG_DIR")
    if given:
        return os.path.abspath(os.path.expanduser(given))
    home = os.environ.get("ROS_HOME") or "~/.ros"
    return os.path.join(os.path.abspath(os.path.expanduser(home)), "log")


def reset() -> None:
    """Reset the calling process's levels and read its environment again; its log file stays open."""
    _state.set(LogState(state().log_file))


def forget_rosout(found: LogState, publish: object) -> None:
    """Remove a publisher of `/rosout` from every logger that uses it."""
    for name in [name for name, each in found.rosout.items() if each == publish]:
        del found.rosout[name]
