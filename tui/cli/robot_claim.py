"""Claims a domain's robot: if several programs start at the same moment, only one starts a robot.

Each would look for a robot before those of the others are up, and find none. So a program that starts a robot holds a
lock file for as long as its robot may run, and a program that finds the lock held waits until that robot is visible.
"""

from __future__ import annotations

import contextlib
import os
import sys
import time
from collections.abc import Callable
from pathlib import Path

from bot_console.runtime.rmw.zenoh.domain.file_lock import open_lock, try_lock

NAME = "robot.lock"
ROBOT_START_TIMEOUT_S = 15.0
"""Seconds to wait for the other program's robot; if there is none by then, that program has ended it."""
CLAIM_POLL_S = 0.1
"""Seconds between two polls for the other program's robot."""


class RobotClaim:
    """A lock on the robot of a domain: a file in the domain's folder. Counts as held if the file cannot be made."""

    def __init__(self, folder: Path) -> None:
        self._path = folder / NAME
        self._handle = -1
        self.held = self._lock()
        """Whether this program holds the claim, so that no other one has a robot or is starting one."""

    def _lock(self) -> bool:
        """Lock the file; also true if the folder or the file system supports no locks."""
        while True:
            try:
                handle = open_lock(self._path)
            except OSError:
                return True
            try:
                got = try_lock(handle)
            except OSError:
                os.close(handle)
                return True
            if got and _is_at(self._path, handle):
                self._handle = handle
                return True
            os.close(handle)
            if not got:
                return False

    @property
    def descriptors(self) -> tuple[int, ...]:
        """Descriptors that let a child process hold the claim too, for as long as it runs; empty on Windows."""
        return (self._handle,) if self._handle >= 0 and sys.platform != "win32" else ()

    def wait_for_robot(self, poll: Callable[[], list[str]], report: Callable[[], None]) -> list[str]:
        """Return the robot that `poll` finds; if another program holds the claim, wait for its robot or its release.

        `report` is called once before waiting.
        """
        deadline, reported = time.monotonic() + ROBOT_START_TIMEOUT_S, False
        while not (found := poll()) and not self.held and time.monotonic() < deadline:
            if not reported:
                report()
            reported = True
            time.sleep(CLAIM_POLL_S)
            self.held = self._lock()
        return found

    def hand_over(self) -> None:
        """Leave the claim to a process that has inherited the descriptor, which holds it until it ends."""
        if self._handle >= 0:
            os.close(self._handle)
        self._handle, self.held = -1, False

    def release(self) -> None:
        """Give up the claim, so that another program may start a robot."""
        if self._handle >= 0:
            with contextlib.suppress(OSError):  # a file that cannot be removed while it is open does no harm
                self._path.unlink()
        self.hand_over()


def _is_at(path: Path, handle: int) -> bool:
    """Whether an open file is the one at this path: its previous holder may have removed it since it was opened."""
    try:
        return os.path.samestat(os.fstat(handle), path.stat())
    except OSError:
        return False
