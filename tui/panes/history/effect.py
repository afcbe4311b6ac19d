"""The effect of a change on the speed of the robot. Pure."""

from __future__ import annotations

from collections import deque
from collections.abc import Collection
from dataclasses import dataclass
from math import isfinite

BEFORE_S = 1.0
"""Seconds before a change, and at the end of what follows it, over which a speed is averaged."""
WATCH_S = 4.0
"""Seconds after a change in which the robot gets to another speed."""
MAX_SPEEDS = 100
"""Speeds that are kept: more than arrive in those seconds."""
MIN_STEP_MPS = 0.05
"""Difference of speeds (m/s) that is worth a word; simulated odometry trembles by less."""
REACHED_SHARE = 0.1
"""The new speed is reached within this share of the step."""


@dataclass(frozen=True)
class _Watch:
    """Changes that were made at one moment (s), and the speed (m/s) before them."""

    changes: Collection[int]
    began: float
    before: float


class Effects:
    """Follows the speed of the robot around changes; times in s of one clock.

    The speed may have changed for another reason, such as an obstacle, so it is called what came after.
    """

    def __init__(self) -> None:
        self._speeds: deque[tuple[float, float]] = deque(maxlen=MAX_SPEEDS)
        self._watch: _Watch | None = None
        self._found: dict[int, str] = {}

    def of(self, change: int) -> str:
        """The effect of a change, by its number; empty if the speed stayed, or is not known yet."""
        return self._found.get(change, "")

    def observe(self, speed: float | None, now: float) -> bool:
        """Take in a speed; whether more is known of a change."""
        if speed is None or not isfinite(speed):
            self._speeds.clear()
            self._watch = None
            return False
        self._speeds.append((now, speed))
        return self._watch is not None and now - self._watch.began >= WATCH_S and self._finish(now)

    def changed(self, changes: Collection[int], now: float) -> None:
        """Values were changed, by their numbers; what came after earlier ones ends here."""
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
