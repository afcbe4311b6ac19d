"""Processes left behind by a child become children of the server, and end with it.

Only Linux supports that (`prctl(2)`, PR_SET_CHILD_SUBREAPER); elsewhere they are left to the system.
"""

from __future__ import annotations

import contextlib
import ctypes
import os
import signal
import threading
from collections.abc import Collection

_SUBREAPER = 36
"""The number of PR_SET_CHILD_SUBREAPER, see prctl(2)."""


def adopt() -> None:
    """Make this process the parent of orphaned descendants from now on."""
    with contextlib.suppress(AttributeError, OSError):  # not supported by this system
        ctypes.CDLL(None).prctl(_SUBREAPER, 1, 0, 0, 0)


def request_exit(sessions: Collection[int], number: signal.Signals) -> bool:
    """Send a signal to the orphans still in these sessions; return whether there are any.

    A process that has started its own session, as a daemon does, is meant to survive.
    """
    left = [pid for pid in _children() if _session(pid) in sessions]
    for pid in left:
        with contextlib.suppress(OSError):
            os.kill(pid, number)
    return bool(left)


def _children() -> list[int]:
    try:
        with open(f"/proc/self/task/{threading.get_native_id()}/children", encoding="ascii") as file:
            return [int(each) for each in file.read().split()]
    except OSError:  # this system does not report it
        return []


def _session(pid: int) -> int:
    try:
        return os.getsid(pid)
    except OSError:  # the process has ended
        return 0
