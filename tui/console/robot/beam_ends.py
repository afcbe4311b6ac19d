"""The end points of a scan's beams, computed on demand, since most of ten scans per second are never drawn."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cached_property
from typing import Any, overload

import numpy as np
import numpy.typing as npt
from bot_console.tui.console.robot.robot_model import Pose
from sensor_msgs.msg import LaserScan

MAX_RANGE_M = 1e7
"""The largest plausible range in m."""


class BeamEnds(Sequence[tuple[float, float]]):
    """The end points (x, y in m) of beams in the frame of the pose; empty if the pose or the angles are not finite."""

    def __init__(self, scan: LaserScan, pose: Pose | None) -> None:
        """Beams without a return are left out: their ranges are infinite or outside the scan's limits (REP 117)."""
        ranges = np.asarray(scan.ranges, float)
        self._valid = np.isfinite(ranges) & (ranges >= scan.range_min) & (ranges <= scan.range_max)
        self._ranges: npt.NDArray[np.float64] = ranges[self._valid]
        self._begin, self._step = scan.angle_min, scan.angle_increment
        self.nearest = float(self._ranges.min()) if len(self._ranges) else None
        """The range of the nearest return (m); None if there is none."""
        bearings = (self._begin, self._step * len(ranges))
        known = pose is not None and all(map(math.isfinite, (pose.heading, *bearings)))
        self._pose = pose if known and len(self._ranges) and self._ranges.max() <= MAX_RANGE_M else None

    @cached_property
    def points(self) -> npt.NDArray[np.float64]:
        """One row per end point."""
        pose = self._pose
        if pose is None:
            return np.empty((0, 2))
        angles = pose.heading + self._begin + self._step * np.flatnonzero(self._valid)
        x, y = pose.x + self._ranges * np.cos(angles), pose.y + self._ranges * np.sin(angles)
        return np.stack([x, y], axis=1)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> npt.NDArray[Any]:
        return self.points.astype(dtype or np.float64)

    def __len__(self) -> int:
        return 0 if self._pose is None else len(self._ranges)

    @overload
    def __getitem__(self, index: int) -> tuple[float, float]: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[tuple[float, float], ...]: ...
    def __getitem__(self, index: int | slice) -> tuple[float, float] | tuple[tuple[float, float], ...]:
        found = self.points[index].tolist()
        return (found[0], found[1]) if isinstance(index, int) else tuple((x, y) for x, y in found)
