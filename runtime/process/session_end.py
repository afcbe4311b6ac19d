"""Ends what is left of a session: the programs that the process which led it has started, and theirs.

A process that has started a session of its own, as a daemon does, is meant to stay. Linux; elsewhere nothing is found.
"""

from __future__ import annotations

import contextlib
import os
import signal
import time

from .watch.processor_time import ENDED_STATES, state_and_seconds

EXIT_TIMEOUT_S = 1.0
"""Seconds that they get after SIGTERM, and again after SIGKILL."""
EXIT_POLL_S = 0.02


def end_session(session: int) -> None:
    """Send SIGTERM, then SIGKILL, to all other processes of a session until none is left, or time is up.

    `session` is the pid of the process that began it.
    """
    for number in (signal.SIGTERM, signal.SIGKILL):
        deadline, signalled = time.monotonic() + EXIT_TIMEOUT_S, set[int]()
        while (left := _members(session)) and time.monotonic() < deadline:
            for pid in left - signalled:
                with contextlib.suppress(OSError):  # it has ended, or belongs to another user
                    os.kill(pid, number)
            signalled |= left
            time.sleep(EXIT_POLL_S)


def _members(session: int) -> set[int]:
    """The processes of a session that still run, except for this one."""
    try:
        numbers = [int(each) for each in os.listdir("/proc") if each.isdecimal()]
    except OSError:  # a system without it
        return set()
    return {pid for pid in numbers if pid != os.getpid() and _runs_in(session, pid)}


def _runs_in(session: int, pid: int) -> bool:
    try:
        if os.getsid(pid) != session:
            return False
    except OSError:  # it has ended
        return False
    reported = state_and_seconds(str(pid))
    return reported is not None and reported[0] not in ENDED_STATES
