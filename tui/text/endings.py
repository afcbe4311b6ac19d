"""Describes how a launched process ended. Pure."""

from __future__ import annotations

import signal
from collections.abc import Iterable

from bot_console.tui.console.model import ProcessInfo, ProcessState
from bot_console.tui.text.figures import age_text

ENDED = (ProcessState.EXITED, ProcessState.CRASHED)


def ending_text(process: ProcessInfo, now: int) -> str:
    """When and how a process ended, such as "ended 3 s ago: exit code 1"; empty if it is running or never ran.

    `now` is in ns since the epoch.
    """
    if process.state not in ENDED or not process.ended:
        return ""
    seconds = max(0, now - process.ended) // 10**9
    when = f"ended {age_text(seconds)} ago" if seconds else "has just ended"
    return f"{when}: {exit_text(process.exit_code or 0)}"


def exit_text(code: int) -> str:
    """An exit code, and the signal that it stands for."""
    try:
        return f"{signal.Signals(-code).name} (exit code {code})" if code < 0 else f"exit code {code}"
    except ValueError:  # a real-time signal
        return f"exit code {code}"


def endings_of_nodes(processes: Iterable[ProcessInfo], now: int) -> dict[str, str]:
    """Describe the ending of each node whose process is known to have ended, unless it also runs in another process."""
    known = [(name, process) for process in processes for name in process.nodes]
    found = {name: text for name, process in known if (text := ending_text(process, now))}
    alive = {name for name, process in known if name in found and not ending_text(process, now)}
    return {name: text for name, text in found.items() if name not in alive}
