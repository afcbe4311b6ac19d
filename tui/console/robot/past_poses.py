"""The robot's poses over the last minutes."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from bot_console.tui.console.robot.robot_model import Pose

MAX_POSES = 12_000
"""The number of poses kept, which is enough for 20 minutes."""
MAX_GAP = 100_000_000
"""Minimum time between two kept poses, in ns."""


class PastPoses:
    """A ring buffer of poses, by time of reception."""

    def __init__(self, capacity: int = MAX_POSES) -> None:
        self._stamps = np.zeros(capacity, np.int64)
        self._poses = np.zeros((capacity, 3))
        self._end = 0

    def add(self, stamp: int, pose: Any) -> None:
        """Keep a pose (`geometry_msgs/Pose`) received at a time (ns since the epoch), unless one came just before."""
        capacity = len(self._stamps)
        if self._end and 0 <= stamp - int(self._stamps[(self._end - 1) % capacity]) < MAX_GAP:
            return
        self._stamps[self._end % capacity] = stamp
        self._poses[self._end % capacity] = (pose.position.x, pose.position.y, heading(pose.orientation))
        self._end += 1

    def at(self, stamp: int) -> Pose | None:
        """The pose at a time (ns since the epoch); None before the first kept pose."""
        order = np.arange(max(0, self._end - len(self._stamps)), self._end) % len(self._stamps)
        place = int(np.searchsorted(self._stamps[order], stamp, side="right")) - 1
        return None if place < 0 else Pose(*self._poses[order[place]].tolist())


def heading(orientation: Any) -> float:
    """The yaw of a quaternion, in rad."""
    q = orientation
    return math.atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))
