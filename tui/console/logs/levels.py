"""Reads and sets the levels of loggers through the logger services of their nodes."""

from __future__ import annotations

from collections.abc import Container, Iterable
from typing import Protocol

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.calls import Calls, NoAnswer
from bot_console.tui.console.model import LoggerLevel, Severity, logger_of
from rcl_interfaces.msg import LoggerLevel as LevelMessage
from rcl_interfaces.srv import GetLoggerLevels, SetLoggerLevels

NONE_OFFERED = "offers no logger service; create it with enable_logger_service=True"


class LoggerNames(Iterable[str], Container[str], Protocol):
    """Names of loggers."""


class LoggerLevels:
    """Queries the nodes' logger services; its coroutines run in the console's executor."""

    def __init__(self, calls: Calls, heard: LoggerNames) -> None:
        """`heard` contains the loggers that have logged, since ROS cannot list the loggers of a node."""
        self._calls = calls
        self._heard = heard

    async def of(self, node: str) -> tuple[LoggerLevel, ...]:
        """The levels of a node's logger and of its children that have logged; raises `ValueError` with the reason."""
        own = logger_of(node)
        names = [own, *sorted(each for each in tuple(self._heard) if each.startswith(f"{own}."))]
        try:
            answer = await self._calls.ask(
                GetLoggerLevels, f"{node}/get_logger_levels", GetLoggerLevels.Request(names=names)
            )
        except NoAnswer as error:
            raise ValueError(f"{node} {NONE_OFFERED}" if "no service" in str(error) else str(error)) from None
        return tuple(LoggerLevel(node, each.name, severity_of(each.level)) for each in answer.levels)

    async def set(self, node: str, severity: Severity, logger: str) -> Answer:
        """Set the level of a node's logger, or of one of its children."""
        level = LevelMessage(name=logger or logger_of(node), level=int(severity))
        try:
            answer = await self._calls.ask(
                SetLoggerLevels, f"{node}/set_logger_levels", SetLoggerLevels.Request(levels=[level])
            )
        except NoAnswer:
            return Answer(False, f"{node} {NONE_OFFERED}")
        result = answer.results[0]
        message_of = (
            f"{level.name} logs {severity.name} and worse" if severity else f"{level.name} logs as its parent does"
        )
        return Answer(result.successful, result.reason or message_of)


def severity_of(level: int) -> Severity:
    """The severity with this number or, if there is none, the next one above it."""
    return next((each for each in Severity if each >= level), Severity.FATAL)
