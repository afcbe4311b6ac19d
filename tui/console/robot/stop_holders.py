"""Finds out whether the processes that hold the robot are still alive, as far as this machine can tell."""

from __future__ import annotations

import os
import platform
import re
from collections.abc import Sequence
from dataclasses import replace

from bot_console.tui.console.robot.robot_model import RobotStop
from bot_console.tui.text.encodable import encodable

_PROCESS = re.compile(r"@(?P<machine>[^@]*) \(pid (?P<pid>[0-9]{1,9})\)")
"""The end of a holder's name, in the form written by `stop_link.StopLink`."""


def mark_gone(stops: Sequence[RobotStop]) -> tuple[RobotStop, ...]:
    """Mark the stops whose holder was a process of this machine that has ended.

    Nothing is known about processes on other machines or holders that are not processes, so these are not marked.
    """
    return tuple(replace(each, gone=True) if not each.here and _is_gone(each.holder) else each for each in stops)


def _is_gone(holder: str) -> bool:
    found = _PROCESS.search(holder)
    if not found or found.end() != len(holder) or found["machine"] != encodable(platform.node()):
        return False
    return not _is_alive(int(found["pid"]))


def _is_alive(pid: int) -> bool:
    if os.name == "nt":  # probing a process there would affect it
        return True
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    except (OSError, OverflowError):  # another user's process, or an invalid pid
        return True
    return not _has_ended(pid)


def _has_ended(pid: int) -> bool:
    """Whether a process has ended without its parent having noticed (a zombie); False if the system does not tell."""
    try:
        with open(f"/proc/{pid}/stat", "rb") as file:
            return file.read().rpartition(b") ")[2][:1] in (b"Z", b"X")
    except OSError:
        return False
