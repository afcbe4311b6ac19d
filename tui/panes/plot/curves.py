"""The curves of a plot: their samples so far, and the part within a time window."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt
from bot_console.tui.console.plot.port import Plots
from bot_console.tui.panes.plot.thresholds import Threshold
from bot_console.tui.text.expression.tree import is_parameter

Array = npt.NDArray[np.float64]
MAX_SAMPLES = 20_000
"""Maximum number of samples kept per curve."""
ROOM = MAX_SAMPLES + MAX_SAMPLES // 4
"""Samples for which memory is allocated at once: arrays that grow a few samples at a time fragment the memory."""


def _empty() -> Array:
    return np.zeros(0)


@dataclass
class Curve:
    """A plotted path and its samples; `problem` says why there are none."""

    path: str
    colour: int = 0
    times: Array = field(default_factory=_empty)
    values: Array = field(default_factory=_empty)
    cursor: int = 0
    problem: str = ""
    headers: Array = field(default_factory=_empty)
    """The times in the headers of the messages; NaN where a message has none."""
    right: bool = False
    """Whether it is measured on the right axis."""
    thresholds: tuple[Threshold, ...] = ()
    by_header: bool = False
    """Whether samples are placed by the times in their headers instead of their arrival times."""
    _room: Array = field(default_factory=lambda: np.zeros((3, 0)), repr=False, compare=False)
    """The allocated arrays, of which times, values and headers are slices; everything after `_end` is free."""
    _end: int = field(default=0, repr=False, compare=False)

    @property
    def steps(self) -> bool:
        """Whether the value holds until the next sample, as a parameter's does."""
        return is_parameter(self.path)

    @property
    def latest(self) -> float | None:
        """The newest value."""
        return float(self.values[-1]) if len(self.values) else None

    @property
    def end(self) -> float | None:
        """The time of the newest sample."""
        times = self.samples()[0]
        return float(times[-1]) if len(times) else None

    def samples(self) -> tuple[Array, Array]:
        """All times, ascending, and values."""
        if not self.by_header or len(self.headers) != len(self.times):
            return self.times, self.values
        times = np.where(np.isfinite(self.headers), self.headers, self.times)
        if np.all(times[1:] >= times[:-1]):
            return times, self.values
        order = np.argsort(times, kind="stable")
        return times[order], self.values[order]

    def at(self, time: float) -> float | None:
        """The value that was the newest one at a time; None before the first."""
        times, values = self.samples()
        place = int(np.searchsorted(times, time, side="right")) - 1
        return float(values[place]) if place >= 0 else None

    def fetch_samples(self, plots: Plots) -> bool:
        """Fetch new samples; returns whether there were any, or the problem has changed."""
        samples = plots.samples(self.path, self.cursor)
        changed = self.problem != samples.problem or samples.cursor != self.cursor
        self.cursor, self.problem = samples.cursor, samples.problem
        if len(samples.times):
            headers = samples.headers if len(samples.headers) else np.full(len(samples.times), np.nan)
            self._add(np.array([samples.times, samples.values, headers], float)[:, -MAX_SAMPLES:])
        return changed

    def _add(self, new: Array) -> None:
        """Append samples; slices of earlier samples that callers hold stay valid."""
        kept, count = min(len(self.times), MAX_SAMPLES - new.shape[1]), new.shape[1]
        first = len(self.times) - kept
        if self._end + count > self._room.shape[1]:
            room = np.empty((3, ROOM))
            for row, old in zip(room, (self.times, self.values, self.headers), strict=True):
                row[:kept] = old[first:]
            self._room, self._end = room, kept
        self._room[:, self._end : self._end + count] = new
        self._end += count
        self.times, self.values, self.headers = self._room[:, self._end - kept - count : self._end]

    def clear(self) -> None:
        """Discard the samples, except for the newest value of a parameter, which still holds."""
        first = len(self.times) - min(1 if self.steps else 0, len(self.times))
        self.times, self.values, self.headers = self.times[first:], self.values[first:], self.headers[first:]

    def between(self, start: float, end: float) -> tuple[Array, Array]:
        """The polyline from `start` to `end` (s): samples inside, one more on either side; NaN breaks it."""
        times, values = self.samples()
        values = np.where(np.isfinite(values), values, np.nan)
        if self.steps and len(times):
            times, values = as_steps(times, values, end)
        first = max(0, int(np.searchsorted(times, start)) - 1)
        last = int(np.searchsorted(times, end, side="right")) + 1
        return times[first:last], values[first:last]


def as_steps(times: Array, values: Array, end: float) -> tuple[Array, Array]:
    """Turn samples into steps: each value holds until the next one, the last one until `end`."""
    moments = np.repeat(times, 2)[1:]
    held = np.repeat(values, 2)[:-1]
    return np.append(moments, max(end, float(times[-1]))), np.append(held, values[-1])


@dataclass(frozen=True)
class ColumnRanges:
    """The lowest and highest value in each column of dots; NaN where there is none."""

    low: Array
    high: Array


def column_ranges(times: Array, values: Array, start: float, end: float, columns: int) -> ColumnRanges:
    """Reduce a polyline to the range of each column of dots, so that drawing costs the same for any length."""
    low, high = np.full(columns, np.nan), np.full(columns, np.nan)
    if len(times) == 0 or end <= start:
        return ColumnRanges(low, high)
    borders = np.linspace(start, end, columns + 1)
    at = np.interp(borders, times, values, left=np.nan, right=np.nan)
    low, high = np.fmin(at[:-1], at[1:]), np.fmax(at[:-1], at[1:])
    inside = (times >= start) & (times <= end) & np.isfinite(values)
    column = np.minimum(((times[inside] - start) / (end - start) * columns).astype(np.int64), columns - 1)
    if len(column):
        np.fmin.at(low, column, values[inside])
        np.fmax.at(high, column, values[inside])
    return ColumnRanges(low, high)
