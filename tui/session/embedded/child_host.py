"""Starts the launch host of a console; imported before the first frame, so that both start at the same time."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from pathlib import Path

from bot_console.runtime.process.session_end import end_session
from bot_console.runtime.process.watch.gil_holder import GilHolder
from bot_console.tui.session.launch_host.child import Host, start_host_process

HANGS = (
    "the launch host {0} hangs in {1}, which holds the interpreter lock: no node that is a thread of it runs. "
    "kill -9 {0} ends all of them"
)


def start_host(options: Sequence[str] = (), *, log: Path | None = None) -> Host:
    """Start a launch host that this process owns; what the host itself prints, normally nothing, goes to `log`."""

    def hangs(pid: int) -> bool:
        return bool(GilHolder(pid).held_in())

    with open(log or os.devnull, "ab") as output:
        return start_host_process(options, output, end_session=end_session, hangs=hangs)


def start_host_of_machine(environment: dict[str, str], output: int) -> Host:
    """Start a launch host that this process owns, for one launch file of the machine's ROS 2."""
    return start_host_process(["--ros"], output, env=environment, end_session=end_session)


def why_it_hangs(pid: int) -> Callable[[], str]:
    """A function that returns why a launch host does not respond, or an empty text if it does."""
    lock = GilHolder(pid)

    def why() -> str:
        held = lock.held_in()
        return HANGS.format(pid, held) if held else ""

    return why
