"""Finds the distance to the obstacle ahead in a scan: which beams point ahead, and how many must agree."""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
import numpy.typing as npt

FRONT_RAD = math.radians(60.0)
"""Angle (rad) to either side of straight ahead within which obstacles limit forward motion."""
MIN_BEAMS = 2
"""Minimum number of beams that must see an obstacle; a single one may have hit dust."""
MIN_ANGLE_RAD, MAX_ANGLE_RAD = 1e-6, 4 * math.pi
"""Limits (rad) of valid angles: the least between beams, and the greatest between beams or of the first beam."""
ROUNDING_RAD = 1e-6
"""Rounding error (rad) of float32 angles."""


def nearest_ahead(ranges: npt.NDArray[np.float32], first: float, increment: float) -> float | None:
    """The distance in m to the obstacle ahead, seen by at least two beams; `inf` if there is none.

    `first` and `increment` are the angles (rad) of the first beam and between two; beams may turn either way and begin
    anywhere. A return of `-inf` (nearer than the sensor can measure) is distance 0. None for an unusable scan: invalid
    angles, or fewer than two beams ahead with a measurement.
    """
    if (
        not (math.isfinite(first) and math.isfinite(increment))
        or abs(first) > MAX_ANGLE_RAD
        or not MIN_ANGLE_RAD < abs(increment) < MAX_ANGLE_RAD
    ):
        return None
    front = ranges[_beams_ahead(len(ranges), first, increment)]
    if len(front) < MIN_BEAMS:
        return None
    seen = float(np.partition(front, MIN_BEAMS - 1)[MIN_BEAMS - 1])  # NaN is sorted last.
    return None if math.isnan(seen) else max(0.0, seen)


@lru_cache(maxsize=4)
def _beams_ahead(count: int, first: float, increment: float) -> npt.NDArray[np.int64] | slice:
    """The indices of the beams ahead, as a slice if they are consecutive; cached, since the geometry hardly changes."""
    angles = first + increment * np.arange(count)
    ahead = np.flatnonzero(np.abs(np.remainder(angles + math.pi, 2 * math.pi) - math.pi) <= FRONT_RAD + ROUNDING_RAD)
    if len(ahead) and ahead[-1] - ahead[0] == len(ahead) - 1:
        return slice(int(ahead[0]), int(ahead[-1]) + 1)
    return ahead
