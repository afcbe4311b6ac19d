"""Which velocity command may drive the robot, and how much of it: priority, freshness, distances."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

FRONT = math.radians(60.0)
"""Half the angle ahead, in rad, in which things stand in the way of driving on."""
WITNESSES = 2
"""Beams that must see a thing; a single one may be dust."""


@dataclass(frozen=True, slots=True)
class Command:
    """A velocity in m/s and rad/s, from a source, at a steady time in ns."""

    source: str
    linear: float
    angular: float
    stamp: int


@dataclass(frozen=True, slots=True)
class Verdict:
    """What was asked, what is final (m/s, rad/s), and the rule or parameter that stands between; empty for none."""

    source: str
    asked: tuple[float, float]
    final: tuple[float, float]
    limited_by: str
    nearest: float


class Arbiter:
    """Keeps the newest command of each source; the first source with a fresh one drives."""

    def __init__(self, sources: Sequence[str], lifetime_ns: int) -> None:
        self._sources = tuple(sources)
        self._lifetime = lifetime_ns
        self._newest: dict[str, Command] = {}

    def offer(self, source: str, linear: float, angular: float, now: int) -> None:
        """Take a command; one that is not finite counts as a stop."""
        if not (math.isfinite(linear) and math.isfinite(angular)):
            linear = angular = 0.0
        self._newest[source] = Command(source, linear, angular, now)

    def choose(self, now: int) -> Command | None:
        """The command that drives now; None when all are older than their lifetime."""
        for source in self._sources:
            command = self._newest.get(source)
            if command and now - command.stamp <= self._lifetime:
                return command
        return None


def nearest_ahead(ranges: npt.NDArray[np.float32], first: float, increment: float) -> float:
    """The distance in m to what stands ahead, seen by two beams at least; `inf` when nothing does.

    A return of `-inf` (nearer than the sensor can measure) is distance 0.
    """
    if increment <= 0.0 or len(ranges) < WITNESSES:
        return math.inf
    low = max(0, math.ceil((-FRONT - first) / increment))
    high = math.floor((FRONT - first) / increment) + 1
    front = ranges[low:high]
    front = front[~np.isnan(front)]
    if len(front) < WITNESSES:
        return math.inf
    return max(0.0, float(np.partition(front, WITNESSES - 1)[WITNESSES - 1]))


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
