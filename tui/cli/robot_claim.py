"""The claim of a domain's robot: of programs that start at the same moment only one brings a robot of its own.

Each looks for a robot before the others' have come up, and sees none. So whoever starts one holds a lock file for as
long as its robot may run, and who finds it held waits until that robot is seen.
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
"""Seconds that a robot has to come up; whoever claimed it and has none by then has ended it."""
POLL = 0.1
"""Seconds between two looks at the other's robot."""


class RobotClaim:
    """A lock on the robot of a domain, by a file in the domain's folder; where none can be kept, as if it were ours."""

    def __init__(self, folder: Path) -> None:
        self._path = folder / NAME
        self._handle = -1
        self.held = self._take()
        """Whether no other program has claimed the robot, or is starting one."""

    def _take(self) -> bool:
        """Lock the file; true as well where no lock can be had, in a folder or on a file system that takes none."""
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
        """What a process inherits that is to hold the claim too, for as long as it runs; empty on Windows."""
        return (self._handle,) if self._handle >= 0 and sys.platform != "win32" else ()

    def seen(self, poll: Callable[[], list[str]], report: Callable[[], None]) -> list[str]:
        """The robot that `look` finds; if another program has claimed one, wait for it, or until it is given up.

        `tell` is called once if there is something to wait for.
        """
        deadline, reported = time.monotonic() + ROBOT_START_TIMEOUT_S, False
        while not (found := poll()) and not self.held and time.monotonic() < deadline:
            if not reported:
                report()
            reported = True
            time.sleep(POLL)
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
            with contextlib.suppress(OSError):  # where an open file cannot be removed it stays, which harms nobody
                self._path.unlink()
        self.hand_over()


def _is_at(path: Path, handle: int) -> bool:
    """Whether an open file is the one at this path: whoever held it may have removed it since it was opened."""
    try:
        return os.path.samestat(os.fstat(handle), path.stat())
    except OSError:
        return False
