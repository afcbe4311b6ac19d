"""Which velocity command may drive the robot, and how fast: priorities, freshness, distances."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import numpy.typing as npt

FRONT = math.radians(60.0)
"""Half the angle ahead, in rad, in which obstacles count for driving forward."""
WITNESSES = 2
"""Beams that must see an obstacle; a single one may be dust."""
MIN_SOURCES, MAX_SOURCES = 1e-6, 4 * math.pi
"""Limits (rad) for the angle between beams and of the whole scan; a sensor cannot mean others."""
EDGE = 1e-6
"""Rounding error (rad) of float32 angles."""


@dataclass(frozen=True, slots=True)
class Command:
    """A velocity in m/s and rad/s, from a source, at a steady time in ns."""

    source: str
    linear: float
    angular: float
    stamp: int


@dataclass(frozen=True, slots=True)
class Verdict:
    """The requested and the final velocity (m/s, rad/s), and the rule or parameter that changed it; empty for none."""

    source: str
    asked: tuple[float, float]
    final: tuple[float, float]
    limited_by: str
    nearest: float


class Arbiter:
    """Keeps the newest command of each source; the first source with a fresh one drives.

    Each source has its own clock (ns): a person's commands age in steady time, a simulated robot's in the time of its
    world.
    """

    def __init__(self, sources: Mapping[str, Callable[[], int]], lifetime_ns: int) -> None:
        self._clocks = dict(sources)
        self._lifetime = lifetime_ns
        self._newest: dict[str, Command] = {}

    def offer(self, source: str, linear: float, angular: float) -> None:
        """Take a command; one that is not finite counts as a stop."""
        if not (math.isfinite(linear) and math.isfinite(angular)):
            linear = angular = 0.0
        self._newest[source] = Command(source, linear, angular, self._clocks[source]())

    def choose(self, *withheld: str) -> Command | None:
        """The command that drives now; None if all have expired, or come from sources that may not drive."""
        for source, clock in self._clocks.items():
            command = self._newest.get(source)
            if command and source not in withheld and 0 <= clock() - command.stamp <= self._lifetime:
                return command
        return None


def nearest_ahead(ranges: npt.NDArray[np.float32], first: float, increment: float) -> float | None:
    """The distance in m to the obstacle ahead, seen by at least two beams; `inf` if there is none.

    `first` and `increment` are the angles (rad) of the first beam and between two; beams may turn either way and begin
    anywhere. A return of `-inf` (nearer than the sensor can measure) is distance 0. None for an unusable scan: invalid
    angles, or fewer than two beams ahead with a measurement.
    """
    if (
        not (math.isfinite(first) and math.isfinite(increment))
        or abs(first) > MAX_SOURCES
        or not MIN_SOURCES < abs(increment) < MAX_SOURCES
    ):
        return None
    front = ranges[_beams_ahead(len(ranges), first, increment)]
    if len(front) < WITNESSES:
        return None
    seen = float(np.partition(front, WITNESSES - 1)[WITNESSES - 1])  # NaN is sorted last.
    return None if math.isnan(seen) else max(0.0, seen)


@lru_cache(maxsize=4)
def _beams_ahead(count: int, first: float, increment: float) -> npt.NDArray[np.int64] | slice:
    """The indices of the beams ahead, as a slice if they are consecutive; cached, as a sensor's geometry hardly
    changes.
    """
    angles = first + increment * np.arange(count)
    ahead = np.flatnonzero(np.abs(np.remainder(angles + math.pi, 2 * math.pi) - math.pi) <= FRONT + EDGE)
    if len(ahead) and ahead[-1] - ahead[0] == len(ahead) - 1:
        return slice(int(ahead[0]), int(ahead[-1]) + 1)
    return ahead


def limit(command: Command, nearest: float, emergency: float, warning: float) -> Verdict:
    """Slow forward driving between `warning` and `emergency` (m), and stop it below; turning and reversing go on."""
    linear, limited_by = command.linear, ""
    if linear > 0.0 and nearest < emergency:
        linear, limited_by = 0.0, "emergency_stop_distance"
    elif linear > 0.0 and nearest < warning:
        linear *= (nearest - emergency) / (warning - emergency)
        limited_by = "warning_distance"
    asked = (command.linear, command.angular)
    return Verdict(command.source, asked, (linear, command.angular), limited_by, nearest)
