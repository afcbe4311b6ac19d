"""Time series, as the panes plot them and watch for alarms. Standard library only."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from bot_console.tui.console.answer import Answer


@dataclass(frozen=True, slots=True)
class Samples:
    """New samples of a watched series: times in s (steady, from the console's start) and values, of equal length."""

    times: Sequence[float]
    values: Sequence[float]
    cursor: int
    """Pass this to the next call to receive only later samples."""
    problem: str = ""
    """Why no samples come, for instance because an array is empty; empty when all is well."""
    headers: Sequence[float] = ()
    """The times in the message headers, on the same axis, NaN where there is none; empty if no message has one."""


class Plots(Protocol):
    """Collects fields of topics, and parameters, over time."""

    def watch(self, path: str, requester: str = "") -> Answer:
        """Collect a series for as long as any requester needs it; the answer says why a path cannot be plotted.

        `/topic/field.sub[2]`, `/topic/array[2:8].mean()` (or min, max, sum, std, len; yaw of a quaternion), or
        `/node:parameter`, or `rate(/topic)`, the messages per second.
        """
        ...

    def unwatch(self, path: str, requester: str = "") -> None:
        """Withdraw one requester's interest in a series; it is discarded when no requester is left."""
        ...

    def samples(self, path: str, after: int = 0) -> Samples:
        """The samples of a watched series that came after a cursor."""
        ...

    def time(self, stamp: int | None = None) -> float:
        """The position (s) of a time (ns since the epoch; None for now) on the time axis that all series share."""
        ...

    def plottable(self) -> Sequence[str]:
        """Paths that `watch` accepts, for completion."""
        ...
