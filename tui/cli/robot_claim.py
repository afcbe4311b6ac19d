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

from bot_console.runtime.rmw.zenoh.domain.file_lock import NO_LINK, try_lock

NAME = "robot.lock"
PATIENCE = 15.0
"""Seconds that a robot has to come up; whoever claimed it and has none by then has ended it."""
POLL = 0.1
"""Seconds between two looks at the other's robot."""


class RobotClaim:
    """A lock on the robot of a domain, by a file in the domain's folder; where none can be kept, as if it were ours."""

    def __init__(self, folder: Path) -> None:
        self._handle = -1
        self.held = True
        """Whether no other program has claimed the robot, or is starting one."""
        with contextlib.suppress(OSError):  # of a folder or a file system that takes no lock
            self._handle = os.open(folder / NAME, os.O_RDWR | os.O_CREAT | NO_LINK, 0o600)
            self.held = try_lock(self._handle)

    @property
    def descriptors(self) -> tuple[int, ...]:
        """What a process inherits that is to hold the claim too, for as long as it runs; empty on Windows."""
        return (self._handle,) if self._handle >= 0 and sys.platform != "win32" else ()

    def seen(self, look: Callable[[], list[str]], tell: Callable[[], None]) -> list[str]:
        """The robot that `look` finds; if another program has claimed one, wait for it, or until it is given up.

        `tell` is called once if there is something to wait for.
        """
        deadline, told = time.monotonic() + PATIENCE, False
        while not (found := look()) and not self.held and time.monotonic() < deadline:
            if not told:
                tell()
            told = True
            time.sleep(POLL)
            self.held = try_lock(self._handle)
        return found

    def release(self) -> None:
        """Let another program bring the robot, unless a process holds the claim that has inherited it."""
        if self._handle >= 0:
            os.close(self._handle)
        self._handle, self.held = -1, False
