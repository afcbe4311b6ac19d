"""Decides which velocity command may drive the robot, and how fast, by priorities, freshness and distances."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Command:
    """A velocity in m/s and rad/s from a source, with its time in ns by the clock of the source."""

    source: str
    linear: float
    angular: float
    stamp: int


@dataclass(frozen=True, slots=True)
class Verdict:
    """The requested and the final velocity (m/s, rad/s), and what limited it: a rule or a parameter, or empty."""

    source: str
    asked: tuple[float, float]
    final: tuple[float, float]
    limited_by: str
    nearest: float


class Arbiter:
    """Keeps the newest command of each source; the first source that has a fresh one drives.

    Each source has its own clock (ns): a person's commands age in steady time, those of a simulated robot's nodes in
    simulated time.
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
        """The command that drives now; None if all have expired or come from `withheld` sources."""
        for source, clock in self._clocks.items():
            command = self._newest.get(source)
            if command and source not in withheld and 0 <= clock() - command.stamp <= self._lifetime:
                return command
        return None


def limit(command: Command, nearest: float, emergency: float, warning: float) -> Verdict:
    """Slow forward motion between the distances `warning` and `emergency` (m) and stop it below; turning and reversing
    are not limited.
    """
    linear, limited_by = command.linear, ""
    if linear > 0.0 and nearest < emergency:
        linear, limited_by = 0.0, "emergency_stop_distance"
    elif linear > 0.0 and nearest < warning:
        linear *= (nearest - emergency) / (warning - emergency)
        limited_by = "warning_distance"
    asked = (command.linear, command.angular)
    return Verdict(command.source, asked, (linear, command.angular), limited_by, nearest)
