"""Counts the process starts that a launch file delays with timers."""

from __future__ import annotations

from typing import Any

from bot_console.tui.console.launch.tree import below


def delayed_starts(service: Any) -> int:
    """The number of pending timers of a LaunchService that will start something.

    Zero if the service does not report what it is waiting for; upstream's does not. Actions that wait for an event,
    such as the end of another process, may never run and do not count.
    """
    from launch.actions import TimerAction

    return sum(isinstance(each, TimerAction) and _starts(each) for each in getattr(service, "pending", ()))


def _starts(entity: Any) -> bool:
    """Whether visiting an entity may start a process; true if only a running launch can decide."""
    from launch.actions import ExecuteLocal, IncludeLaunchDescription, OpaqueCoroutine, OpaqueFunction

    starting = (ExecuteLocal, IncludeLaunchDescription, OpaqueCoroutine, OpaqueFunction)
    return isinstance(entity, starting) or any(map(_starts, below(entity)))
