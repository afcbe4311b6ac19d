"""Filters the noise from a scan and detects obstacles: groups of neighbouring beams."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from bot_console_robot.common.scans import Floats

MAX_GAP_M = 0.35
"""Neighbouring returns closer than this (m) belong to the same object."""
MIN_BEAMS = 3
"""Minimum number of beams for an object to be reported."""


@dataclass(frozen=True, slots=True)
class Detection:
    """An obstacle at x, y (m, from the sensor, x ahead), `width` m across, and the shortest distance to it in m."""

    x: float
    y: float
    width: float
    distance: float


def median_of_three(ranges: Floats) -> Floats:
    """Replace each range by the median of itself and its neighbours, which removes single stray beams."""
    if len(ranges) < 3:
        return ranges
    result: Floats = np.array(ranges)
    left, middle, right = ranges[:-2], ranges[1:-1], ranges[2:]
    result[1:-1] = np.maximum(np.minimum(left, middle), np.minimum(np.maximum(left, middle), right))
    return result


def without_weak_returns(ranges: Floats, intensities: Floats, threshold: int) -> Floats:
    """Return the ranges without returns weaker than the threshold (`+inf`: no return)."""
    if len(intensities) != len(ranges):
        return ranges
    return np.where(intensities >= threshold, ranges, np.float32(math.inf))


def find(ranges: Floats, first: float, increment: float) -> list[Detection]:
    """Return groups of returns, from right to left."""
    index = (np.isfinite(ranges) & (ranges > 0.0)).nonzero()[0]
    if not len(index):
        return []
    angle = first + increment * index
    depth = ranges[index].astype(np.float64)
    x, y = depth * np.cos(angle), depth * np.sin(angle)
    apart = (np.hypot(x[1:] - x[:-1], y[1:] - y[:-1]) > MAX_GAP_M) | (index[1:] - index[:-1] > 2)
    starts = np.concatenate(([0], apart.nonzero()[0] + 1))
    ends = np.concatenate((starts[1:], [len(index)]))
    beams = ends - starts
    middle_x, middle_y = np.add.reduceat(x, starts) / beams, np.add.reduceat(y, starts) / beams
    width = np.hypot(x[ends - 1] - x[starts], y[ends - 1] - y[starts])
    things = np.array((middle_x, middle_y, width, np.minimum.reduceat(depth, starts)), np.float64)
    return [Detection(*map(float, thing)) for thing in np.transpose(things[:, beams >= MIN_BEAMS])]
