"""Filters of log calls: throttle, skip the first, once."""

from __future__ import annotations

from typing import Any

from bot_console.runtime.process import current
from rclpy.impl.any_clock import AnyClock

OPTIONS = ("throttle_duration_sec", "throttle_time_source_type", "skip_first", "once")


def detect(options: dict[str, Any]) -> tuple[str, ...]:
    """Return the filters that a call's options select, in order of application; `TypeError` for other options."""
    for name in options:
        if name == "severity":
            raise TypeError("RcutilsLogger.log() got multiple values for argument 'severity'")
        if name not in OPTIONS:
            raise TypeError(f'parameter "{name}" is not one of the recognized logging options "{list(OPTIONS)}"')
    found: list[str] = []
    if options.get("throttle_duration_sec") or options.get("throttle_time_source_type"):
        if "throttle_duration_sec" not in options:
            raise TypeError(
                'required parameter "throttle_duration_sec" not specified but is required for the '
                'the logging filter "throttle"'
            )
        for name in OPTIONS[:2]:
            if options.get(name, ...) is None:
                raise TypeError(f'Required parameter "{name}" was not specified for logging filter "Throttle"')
        found.append("throttle")
    if options.get("skip_first"):
        found.append("skip_first")
    if options.get("once"):
        found.append("once")
    return tuple(found)


class Site:
    """The state of one call site of a logger in a program."""

    __slots__ = ("_clock", "_done", "_last", "_skipped", "filters", "name", "options", "severity")

    def __init__(self, severity: int, name: str, filters: tuple[str, ...], options: dict[str, Any]) -> None:
        self.severity = severity
        self.name = name
        self.filters = filters
        self.options = options
        self._skipped = self._done = False
        self._last = 0
        self._clock = _clock(options) if "throttle" in filters else None

    def allows(self) -> bool:
        """Whether the filters let this call pass."""
        return all(getattr(self, f"_{name}")() for name in self.filters)

    def _throttle(self) -> bool:
        now = self._clock.now().nanoseconds if self._clock is not None else current().clock.system_ns()
        if now < self._last + int(self.options["throttle_duration_sec"] * 1e9):
            return False
        self._last = now
        return True

    def _skip_first(self) -> bool:
        skipped, self._skipped = self._skipped, True
        return skipped

    def _once(self) -> bool:
        done, self._done = self._done, True
        return not done


def _clock(options: dict[str, Any]) -> AnyClock | None:
    """Return the clock that a call's options name; None means system time."""
    if "throttle_time_source_type" not in options:
        return None
    clock = options["throttle_time_source_type"]
    if not isinstance(clock, AnyClock):
        raise ValueError(f'Received throttle_time_source_type of "{clock}" is not a clock instance')
    return clock
