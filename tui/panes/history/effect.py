"""The effect of a change on the speed of the robot. Pure."""

from __future__ import annotations

from collections import deque
from collections.abc import Collection
from dataclasses import dataclass
from math import isfinite

BEFORE_S = 1.0
"""The speed is averaged over this many seconds before a change, and at the end of the time watched after it."""
WATCH_S = 4.0
"""Seconds for which the speed is watched after a change."""
MAX_SPEEDS = 100
"""Maximum number of speeds kept: more than arrive while a change is watched."""
MIN_STEP_MPS = 0.05
"""Smallest difference of speeds (m/s) that is reported; the noise of simulated odometry is below it."""
REACHED_SHARE = 0.1
"""The new speed counts as reached when the difference is below this share of the step."""


@dataclass(frozen=True)
class _Watch:
    """Changes made at the same moment (s), and the speed (m/s) before them."""

    changes: Collection[int]
    began: float
    before: float


class Effects:
    """Compares the robot's speed before and after each change; all times are in s of the same clock.

    The speed may have changed for another reason, such as an obstacle, so the text claims no cause.
    """

    def __init__(self) -> None:
        self._speeds: deque[tuple[float, float]] = deque(maxlen=MAX_SPEEDS)
        self._watch: _Watch | None = None
        self._found: dict[int, str] = {}

    def of(self, change: int) -> str:
        """The effect of the change with this number; empty if the speed stayed the same, or is not known yet."""
        return self._found.get(change, "")

    def observe(self, speed: float | None, now: float) -> bool:
        """Record a speed; returns whether the effect of a change has become known."""
        if speed is None or not isfinite(speed):
            self._speeds.clear()
            self._watch = None
            return False
        self._speeds.append((now, speed))
        return self._watch is not None and now - self._watch.began >= WATCH_S and self._finish(now)

    def changed(self, changes: Collection[int], now: float) -> None:
        """Start to watch the changes with these numbers; ends the watch of earlier ones."""
        self._finish(now)
        before = self._mean(now - BEFORE_S, now)
        self._watch = None if before is None else _Watch(tuple(changes), now, before)

    def _finish(self, now: float) -> bool:
        watch, self._watch = self._watch, None
        if watch is None or now - watch.began < BEFORE_S:
            return False
        after = self._mean(now - BEFORE_S, now)
        step = 0.0 if after is None else after - watch.before
        if after is None or abs(step) < MIN_STEP_MPS:
            return False
        near = (
            at for at, speed in self._speeds if at > watch.began and abs(speed - after) <= REACHED_SHARE * abs(step)
        )
        seconds = next(near, now) - watch.began
        text = f"speed {watch.before:.1f} → {after:.1f} m/s in {seconds:.1f} s"
        self._found.update(dict.fromkeys(watch.changes, text))
        return True

    def _mean(self, begin: float, end: float) -> float | None:
        inside = [speed for at, speed in self._speeds if begin <= at <= end]
        return sum(inside) / len(inside) if inside else None
