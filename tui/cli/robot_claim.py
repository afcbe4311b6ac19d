"""The claim of a domain's robot: if several programs start at the same moment, only one starts a robot.

Each looks for a robot before those of the others are up, and finds none. So a program that starts one holds a lock file
for as long as its robot may run, and a program that finds the lock held waits until that robot is visible.
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
"""Seconds that a robot has to come up; a program that claimed it and has none by then has ended it."""
CLAIM_POLL_S = 0.1
"""Seconds between two polls for the other program's robot."""


class RobotClaim:
    """A lock on the robot of a domain, by a file in the domain's folder; counts as held if no file can be made
    there.
    """

    def __init__(self, folder: Path) -> None:
        self._path = folder / NAME
        self._handle = -1
        self.held = self._take()
        """Whether this program holds the claim: no other one has, or is starting, a robot."""

    def _take(self) -> bool:
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

    def seen(self, poll: Callable[[], list[str]], report: Callable[[], None]) -> list[str]:
        """The robot that `poll` finds; if another program has claimed one, waits for it, or until the claim is given
        up.

        `report` is called once if there is something to wait for.
        """
        deadline, reported = time.monotonic() + ROBOT_START_TIMEOUT_S, False
        while not (found := poll()) and not self.held and time.monotonic() < deadline:
            if not reported:
                report()
            reported = True
            time.sleep(CLAIM_POLL_S)
            self.held = self._take()
        return found

    def hand_over(self) -> None:
        """Leave the claim to a process that has inherited it, which holds it until it ends."""
        if self._handle >= 0:
            os.close(self._handle)
        self._handle, self.held = -1, False

    def release(self) -> None:
        """Let another program bring the robot."""
        if self._handle >= 0:
            with contextlib.suppress(OSError):  # If an open file cannot be removed it stays, which does no harm.
                self._path.unlink()
        self.hand_over()


def _is_at(path: Path, handle: int) -> bool:
    """Whether an open file is the one at this path: its previous holder may have removed it since it was opened."""
    try:
        return os.path.samestat(os.fstat(handle), path.stat())
    except OSError:
        return False
