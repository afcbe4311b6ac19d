"""A robot's diagnostics as the panes see them: each status, and when it counts as stale. Standard library only."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

STALE_AFTER_S = 5.0
"""Seconds without an update after which a status counts as stale, as in rqt_robot_monitor."""


class Level(IntEnum):
    """The levels of `diagnostic_msgs/msg/DiagnosticStatus`, with its codes."""

    OK = 0
    WARN = 1
    ERROR = 2
    STALE = 3

    @property
    def weight(self) -> int:
        """The severity as a number: an error is worse than stale, and stale is worse than a warning."""
        return (0, 1, 3, 2)[self]


@dataclass(frozen=True, slots=True)
class ReportedStatus:
    """A change of a status: its level, or its message at the same level; `stamp` is in ns since the epoch."""

    stamp: int
    level: Level
    message: str


@dataclass(frozen=True, slots=True)
class Status:
    """The latest status of one part of the robot. The slashes in its name separate the levels of a tree."""

    name: str
    level: Level
    message: str = ""
    hardware: str = ""
    values: tuple[tuple[str, str], ...] = ()
    last_received: float = 0.0
    """When it was last received, in s of a monotonic clock."""
    history: tuple[ReportedStatus, ...] = ()
    """Its past changes, newest last."""

    def now(self, clock: float) -> Level:
        """The level, or stale if nothing has been received for too long."""
        return Level.STALE if clock - self.last_received > STALE_AFTER_S else self.level


@dataclass(frozen=True, slots=True)
class Diagnostics:
    """The latest status of each name; `problem` says why there is none, and is empty if all is well."""

    statuses: tuple[Status, ...] = ()
    topics: tuple[str, ...] = ()
    """The topics that the statuses come from."""
    dropped: int = 0
    """The number of names beyond the maximum."""
    problem: str = ""
