"""Describes the origin of a parameter's value for users."""

from __future__ import annotations

import time

from bot_console.tui.console.model import ChangeSource

START = "start value"
"""The value that a parameter had when the console first saw it; ROS does not report the declared one."""

SET_BY = {
    ChangeSource.EDIT: "set here",
    ChangeSource.UNDO: "set here by undo",
    ChangeSource.REDO: "set here by redo",
    ChangeSource.PROFILE: "set here by a profile",
    ChangeSource.FILE: "set here from a file",
    ChangeSource.HISTORY: "set here from the history",
    ChangeSource.ROLLBACK: "restored here because another node refused",
    ChangeSource.OTHER: "set by another program or the node",
}


def origin_text(source: ChangeSource, stamp: int) -> str:
    """Who set a value, and when (ns since the epoch, shown in local time)."""
    return f"{SET_BY[source]} at {time.strftime('%H:%M:%S', time.localtime(stamp // 10**9))}"
