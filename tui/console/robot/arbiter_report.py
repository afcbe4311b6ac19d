"""Parses the report of a velocity arbiter on its last decision."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

Velocity = tuple[float, float]
"""Linear (m/s) and angular (rad/s) velocity."""


@dataclass(frozen=True)
class Verdict:
    """An arbiter's decision on the command that it selected: the rule or parameter that limited it, and the result."""

    limited_by: str = ""
    asked: Velocity | None = None
    limited: Velocity | None = None

    @classmethod
    def of(cls, values: Mapping[str, str]) -> Verdict:
        """Parse the values of a report."""
        return cls(values["limited_by"], _velocity(values, "asked"), _velocity(values, "final"))


def _velocity(values: Mapping[str, str], prefix: str) -> Velocity | None:
    """A velocity given as `<prefix>.linear` and `<prefix>.angular`; None if either is missing."""
    try:
        return float(values[f"{prefix}.linear"]), float(values[f"{prefix}.angular"])
    except (KeyError, ValueError):
        return None
