"""End a process: SIGINT, then SIGTERM, then SIGKILL if it does not end."""

from __future__ import annotations

import asyncio
import signal
from functools import partial
from typing import TYPE_CHECKING, Any

from launch.events import matches_action
from launch.events.process import SignalProcess
from launch.utilities import perform_substitutions

if TYPE_CHECKING:
    from logging import Logger

    from launch.launch_context import LaunchContext

SIGTERM_TIMEOUT_S = SIGKILL_TIMEOUT_S = "5"
"""Seconds between SIGINT and SIGTERM, and between SIGTERM and SIGKILL, unless the launch file says otherwise."""


class Escalation:
    """Timers that send a process stronger signals until it has ended."""

    def __init__(self, action: Any, context: LaunchContext, logger: Logger) -> None:
        self._action = action
        self._context = context
        self._logger = logger
        sigterm = perform_substitutions(context, action.sigterm_timeout)
        sigkill = perform_substitutions(context, action.sigkill_timeout)
        both = float(sigterm) + float(sigkill)
        later = context.asyncio_loop.call_later
        self._timers: list[asyncio.TimerHandle] = [
            later(float(sigterm), partial(self._escalate, sigterm, "SIGINT", "SIGTERM")),
            later(both, partial(self._escalate, str(both), "SIGTERM", "SIGKILL")),
        ]

    def interrupt(self) -> None:
        """Send SIGINT."""
        self._emit("SIGINT")

    def cancel(self) -> None:
        """Stop the timers, once the process has ended."""
        for timer in self._timers:
            timer.cancel()

    def _escalate(self, seconds: str, before: str, now: str) -> None:
        name = self._action.process_description.final_name
        self._logger.error(
            f"process[{name}] failed to terminate '{seconds}' seconds after receiving '{before}', escalating to '{now}'"
        )
        self._emit(now)

    def _emit(self, name: str) -> None:
        number: int | str = name if name == "SIGKILL" else signal.Signals[name]
        event = SignalProcess(signal_number=number, process_matcher=matches_action(self._action))
        self._context.emit_event_sync(event)
