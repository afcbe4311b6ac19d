"""Ends what is left of a session: the programs that its leader started, and those that they started.

A process that has started its own session, as a daemon does, is meant to survive. Linux only; elsewhere nothing is
found.
"""

from __future__ import annotations

import contextlib
import os
import signal
import time

from .watch.processor_time import ENDED_STATES, state_and_seconds

EXIT_TIMEOUT_S = 1.0
"""Time (s) that the processes get after SIGTERM, and again after SIGKILL."""
EXIT_POLL_S = 0.02


def end_session(session: int) -> None:
    """Send SIGTERM, then SIGKILL, to all other processes of a session until none is left, or time is up.

    `session` is the pid of the session's leader.
    """
    for number in (signal.SIGTERM, signal.SIGKILL):
        deadline, signalled = time.monotonic() + EXIT_TIMEOUT_S, set[int]()
        while (left := _members(session)) and time.monotonic() < deadline:
            for pid in left - signalled:
                with contextlib.suppress(OSError):  # the process has ended, or belongs to another user
                    os.kill(pid, number)
            signalled |= left
            time.sleep(EXIT_POLL_S)


def _members(session: int) -> set[int]:
    """Return the running processes of a session, except this one."""
    try:
        numbers = [int(each) for each in os.listdir("/proc") if each.isdecimal()]
    except OSError:  # not supported by this system
        return set()
    return {pid for pid in numbers if pid != os.getpid() and _runs_in(session, pid)}


def _runs_in(session: int, pid: int) -> bool:
    try:
        if os.getsid(pid) != session:
            return False
    except OSError:  # the process has ended
        return False
    reported = state_and_seconds(str(pid))
    return reported is not None and reported[0] not in ENDED_STATES
