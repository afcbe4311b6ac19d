"""Loggers."""

from __future__ import annotations

import sys
import warnings
from typing import Any

from bot_console.runtime.distribution import distribution
from bot_console.runtime.process import current
from rclpy.impl.log_filters import Site, detect
from rclpy.impl.log_routing import state
from rclpy.impl.logging_severity import LoggingSeverity

DEBUG, INFO, WARN, ERROR, FATAL = 10, 20, 30, 40, 50
_frame = sys._getframe  # pyright: ignore[reportPrivateUsage] -- documented in `sys`


class RcutilsLogger:
    """Logs under a name; dots separate the names of loggers from their children's.

    Each call takes the message and the filters `throttle_duration_sec` (s), `throttle_time_source_type`, `skip_first`
    and `once`, and returns whether the message was logged. The same call site may not change severity or filters
    between calls (`ValueError`); a message that is not a string raises `TypeError`.
    """

    def __init__(self, name: str = "") -> None:
        self.name = name
        self._sites: dict[tuple[str, str, int, int], Site] = {}

    def get_child(self, name: str) -> RcutilsLogger:
        """Return the logger `<this>.<name>`; `ValueError` for an empty name, `TypeError` for anything but a string."""
        if not self.name:
            raise ValueError("Logger name must not be empty.")
        if not name:
            raise ValueError("Child logger name must not be empty.")
        child = RcutilsLogger(self.name + "." + name)
        publish = state().rosout.get(self.name)
        if publish is not None:
            state().rosout.setdefault(child.name, publish)
        return child

    def set_level(self, level: LoggingSeverity | int) -> None:
        """Set the lowest severity that is logged; raises `ValueError` for an invalid number."""
        state().set_level(self.name, LoggingSeverity(level))

    def get_effective_level(self) -> LoggingSeverity:
        """Return the lowest severity that is logged."""
        return LoggingSeverity(state().effective_level(self.name))

    def is_enabled_for(self, severity: LoggingSeverity | int) -> bool:
        """Whether messages of that severity are logged."""
        return LoggingSeverity(severity) >= state().effective_level(self.name)

    def debug(self, message: str, **kwargs: object) -> bool:
        """Log a message for debugging."""
        return self._log(message, DEBUG, kwargs)

    def info(self, message: str, **kwargs: object) -> bool:
        """Log what the program is doing."""
        return self._log(message, INFO, kwargs)

    def warning(self, message: str, **kwargs: object) -> bool:
        """Log a possible problem."""
        return self._log(message, WARN, kwargs)

    def warn(self, message: str, **kwargs: object) -> bool:
        """Log as `warning` does."""
        if distribution().warn_is_deprecated:
            text = "Deprecated in favor of :py:classmethod:RcutilsLogger.warning:."
            warnings.warn(text, DeprecationWarning, stacklevel=2)
        return self._log(message, WARN, kwargs)

    def error(self, message: str, **kwargs: object) -> bool:
        """Log an error."""
        return self._log(message, ERROR, kwargs)

    def fatal(self, message: str, **kwargs: object) -> bool:
        """Log an error that ends the program."""
        return self._log(message, FATAL, kwargs)

    def log(self, message: str, severity: LoggingSeverity | int, **kwargs: object) -> bool:
        """Log with a severity given as a value."""
        return self._log(message, LoggingSeverity(severity), kwargs)

    def _log(self, message: str, severity: int, options: dict[str, Any]) -> bool:
        shared = state()
        name = self.name
        if severity < (shared.effective.get(self.name) or shared.effective_level(self.name)):
            return False
        # The caller of `info` or a similar method, which calls this one.
        frame = _frame(2)
        code = frame.f_code
        line = frame.f_lineno
        # Includes `f_lasti`, as there may be two calls on one line.
        key = (code.co_name, code.co_filename, line, frame.f_lasti)
        site = self._sites.get(key)
        if options:
            name = options.pop("name", name)
        if site is None:
            site = self._sites[key] = Site(severity, name, detect(options), options)
        elif site.severity != severity:
            raise ValueError("Logger severity cannot be changed between calls.")
        elif site.name != name:
            raise ValueError("Logger name cannot be changed between calls.")
        elif options or site.options:
            _check_unchanged(site, options)
        if site.filters and not site.allows():
            return False
        if type(message) is not str:
            message = _text(message)
        if "\0" in message:
            message = message.partition("\0")[0]  # as upstream, where C strings end there
        stamp = current().clock.system_ns()
        shared.write(severity, name, message, code.co_filename, code.co_name, line, stamp)
        return True


def _check_unchanged(site: Site, options: dict[str, Any]) -> None:
    if detect(options) != site.filters:
        raise ValueError("Requested logging filters cannot be changed between calls.")
    if options != site.options:
        raise ValueError("Logging filter parameters cannot be changed between calls.")


def _text(message: object) -> str:
    """Convert a message that is not a plain `str`, as upstream's C layer does."""
    if message is None:
        return "(null)"
    if isinstance(message, str):
        return str(message)
    if isinstance(message, bytes):
        return message.decode("utf-8", "replace")
    raise TypeError(f"the message of a log call must be a string, not {type(message).__name__}: {message!r}")
