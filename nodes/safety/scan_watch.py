"""The obstacle ahead in the newest scan, and whether that scan can still be trusted."""

from __future__ import annotations

import math
from collections.abc import Callable

from bot_console_robot.common.scans import ranges_of
from bot_console_robot.safety.obstacle_ahead import nearest_ahead
from sensor_msgs.msg import LaserScan


class ScanWatch:
    """Takes scans, whose fields may contain anything; an unusable scan counts as not received."""

    def __init__(self, clock: Callable[[], int], lifetime_ns: int) -> None:
        self._clock = clock
        self._lifetime = lifetime_ns
        self._taken: int | None = None
        self.stamp = 0
        """The stamp of the last scan, in ns."""
        self.nearest = math.inf
        """The distance (m) to the obstacle ahead in the last usable scan."""

    def take(self, scan: LaserScan) -> bool:
        """Take a scan; returns whether it was usable.

        A scan that is not newer than the one before is not usable: it was late, or sent twice. The next one is compared
        with its stamp nevertheless, since a simulation that is reset starts again from zero.
        """
        stamp = scan.header.stamp.sec * 1_000_000_000 + scan.header.stamp.nanosec
        before, self.stamp = self.stamp, stamp
        if stamp and stamp <= before:
            return False
        nearest = nearest_ahead(ranges_of(scan), scan.angle_min, scan.angle_increment)
        if nearest is None:
            return False
        self.nearest, self._taken = nearest, self._clock()
        return True

    @property
    def age(self) -> float:
        """Nanoseconds since the last usable scan; infinite if there was none."""
        return math.inf if self._taken is None else self._clock() - self._taken

    @property
    def fresh(self) -> bool:
        """Whether the last usable scan is recent enough."""
        return 0 <= self.age <= self._lifetime
