"""The port for time series, which the panes plot and check for alarms. Standard library only."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from bot_console.tui.console.answer import Answer


@dataclass(frozen=True, slots=True)
class Samples:
    """New samples of a watched series: their times (s since the console's start) and values, of equal length."""

    times: Sequence[float]
    values: Sequence[float]
    cursor: int
    """The cursor to pass to the next call, to receive only later samples."""
    problem: str = ""
    """Why there are no samples, for instance because an array is empty; empty when all is well."""
    headers: Sequence[float] = ()
    """The times in the message headers, on the same axis, NaN where a header has none; empty if no message has one."""


class Plots(Protocol):
    """Collects fields of topics and parameters over time."""

    def watch(self, path: str, requester: str = "") -> Answer:
        """Collect a series for as long as any requester needs it; an unsuccessful answer says why the path cannot be
        plotted.

        A path is `/topic/field.sub[2]`, `/topic/array[2:8].mean()` (or min, max, sum, std, len; yaw of a quaternion),
        `/node:parameter`, or `rate(/topic)`, the messages per second.
        """
        ...

    def unwatch(self, path: str, requester: str = "") -> None:
        """Withdraw a requester's interest in a series; it is discarded when no requester is left."""
        ...

    def samples(self, path: str, after: int = 0) -> Samples:
        """The samples of a watched series after a cursor."""
        ...

    def time(self, stamp: int | None = None) -> float:
        """The position (s) of a time (ns since the epoch; None: now) on the time axis that all series share."""
        ...

    def plottable(self) -> Sequence[str]:
        """The paths that `watch` accepts, for completion."""
        ...
