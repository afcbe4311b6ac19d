"""The parts of a plot: curves, markers, and the time window."""

from __future__ import annotations

import math
from collections.abc import Sequence

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.model import Change
from bot_console.tui.console.plot.port import Plots
from bot_console.tui.panes.plot.curves import Curve
from bot_console.tui.panes.plot.formulas.computed import Computed
from bot_console.tui.panes.plot.formulas.formula import Formula, read
from bot_console.tui.panes.plot.thresholds import first_crossed
from bot_console.tui.panes.plot.view import Axes, Mark
from bot_console.tui.text.value_text import value_text

WINDOWS_S = (1.0, 2.0, 5.0, 10.0, 30.0, 60.0, 120.0, 300.0, 600.0)
"""Lengths of the time window, s."""

DEFAULTS = ("/odom/twist.twist.linear.x", "/robot_navigator:max_speed")
"""The curves that are plotted before anybody has asked for something: ends of paths."""

COLOURS = 6

PACE_S = 0.5
"""Seconds for which the window stands still, where that is no more than a share of its width."""

LATEST_VALUE_S = 0.3
"""Seconds after which the newest value is told, though it lies in the same dot as the one before."""

MIN_STEPS = 20
"""The window moves in at least so many steps through its own width."""


class Timeline:
    """Curves over a window of time that ends at the newest sample, or stands while paused."""

    def __init__(self, plots: Plots) -> None:
        self._plots = plots
        self.curves: list[Curve] = []
        self.against = ""
        """The path of the curve that is drawn in place of time; empty: time."""
        self.by_header = False
        """Whether samples lie where the headers of their messages say."""
        self._sources: dict[str, Curve] = {}
        self._uses: dict[str, tuple[str, ...]] = {}
        """The paths that each curve needs."""
        self.marks: list[Mark] = []
        self.window = 30.0
        self.limits: tuple[float, float] | None = None
        self.paused_at: float | None = None
        self.new_samples = 0
        self.cursor: float | None = None
        """The moment that is looked at, s."""

    def add(self, text: str) -> Answer:
        """One more curve, of a path or an expression, in the first free colour; says why not."""
        found: Formula | str = text
        if text not in self._plots.plottable():
            try:
                found = read(text)
            except ValueError as error:
                if any(each in "()*+-% " for each in text):
                    return Answer(False, f"{text}: {error}")
        if any(each.path == (found if isinstance(found, str) else text) for each in self.curves):
            return Answer(True, text)
        paths = (found,) if isinstance(found, str) else found.paths
        for at, path in enumerate(paths):
            answer = self._plots.watch(path) if path not in self._sources else Answer(True)
            if not answer.ok:
                self._forget(paths[:at])
                return answer
        sources = {path: self._source(path) for path in paths}
        used = {each.colour for each in self.curves}
        colour = next((each for each in range(COLOURS) if each not in used), len(self.curves) % COLOURS)
        if isinstance(found, str):
            curve = sources[found]
            curve.colour = colour
        else:
            curve = Computed(found, colour, sources)
        self.curves.append(curve)
        self._uses[curve.path] = paths
        return Answer(True, text)

    def _source(self, path: str) -> Curve:
        found = self._sources.get(path)
        if found is None:
            found = self._sources[path] = Curve(path, by_header=self.by_header)
        return found

    def remove(self, at: int) -> None:
        """Forget a curve, and its samples where no other one needs them."""
        curve = self.curves.pop(at)
        self.against = "" if self.against == curve.path else self.against
        self._forget(self._uses.pop(curve.path))

    def _forget(self, paths: Sequence[str]) -> None:
        needed = {path for paths in self._uses.values() for path in paths}
        for path in paths:
            if path not in needed:
                self._sources.pop(path, None)
                self._plots.unwatch(path)

    def time_of(self, by_header: bool) -> None:
        """Place samples by the headers of messages, or by when these came."""
        self.by_header = by_header
        for each in self._sources.values():
            each.by_header = by_header

    def clear(self) -> None:
        """Forget all samples and marks."""
        for each in self._sources.values():
            each.clear()
        self.marks.clear()

    def take_in(self) -> bool:
        """Fetch new samples; whether anything has to be drawn."""
        before = sum(each.cursor for each in self._sources.values())
        changed = any([each.take_in(self._plots) for each in self._sources.values()])
        for each in self.curves:
            if each.path not in self._sources:
                each.take_in(self._plots)
        if self.paused_at is not None:
            self.new_samples += sum(each.cursor for each in self._sources.values()) - before
        return changed

    def set_window(self, seconds: float) -> None:
        """The length of the window that is nearest to so many seconds."""
        self.window = min(WINDOWS_S, key=lambda each: abs(each - seconds))

    def marks_of(self, changes: Sequence[Change]) -> None:
        """Mark parameter changes and refusals."""
        if not changes:
            self.marks = []
            return

        self.marks = [Mark(self._plots.time(each.stamp), not each.accepted, change_text(each)) for each in changes]

    def watch_image(self, stamp: int | None) -> None:
        """Hold the window so that it shows a moment (ns since the epoch); at None let it follow again."""
        if stamp is None:
            self.cursor = self.paused_at = None
            self.new_samples = 0
            return
        if self.paused_at is None:
            self.pause()
        self.cursor = self._plots.time(stamp)
        end = self.paused_at or 0.0
        edge = self.window / 20
        if not end - self.window + edge <= self.cursor <= end - edge:
            self.paused_at = self.cursor + self.window / 2

    def next_mark(self, step: int) -> float | None:
        """The time of the next mark after the cursor, or before it; None where there is none."""
        times = sorted({each.time for each in self.marks})
        at = self.cursor if self.cursor is not None else self.newest()
        later = [each for each in times if (each > at if step > 0 else each < at)]
        return None if not later else later[0] if step > 0 else later[-1]

    def pause(self) -> None:
        """Hold the window where it is, or let it follow again."""
        self.paused_at = self.newest() if self.paused_at is None else None
        self.new_samples = 0

    def stamp_of(self, time: float) -> int:
        """The moment (ns since the epoch) of a time of the axis."""
        return round((time - self._plots.time(0)) * 1e9)

    def wall(self, time: float) -> float:
        """The same in s."""
        return self.stamp_of(time) / 1e9

    def beside_cursor(self, step: int, across: int) -> int:
        """The moment so many cells beside the cursor, or where there is none before the newest sample."""
        axes = self.axes(across)
        at = self.cursor if self.cursor is not None else min(self.newest(), axes.end)
        return self.stamp_of(at + step * self.window / max(1, across))

    def crossed(self) -> list[str]:
        """The paths whose value lies beyond one of its thresholds, at the cursor or else now."""
        found: list[str] = []
        for each in self.curves:
            value = each.latest if self.cursor is None else each.at(self.cursor)
            over = first_crossed(each.thresholds, value)
            if over is not None:
                found.append(f"! {each.path} {over.text}")
        return found

    def shift(self, step: int) -> None:
        """Move a held window by a tenth of its length."""
        if self.paused_at is not None:
            self.paused_at += step * self.window / 10

    def newest(self) -> float:
        """The time of the newest sample of a topic; with parameters alone, now."""
        streams = [end for each in self.curves if not each.steps and (end := each.end) is not None]
        return max(streams) if streams else self._plots.time()

    def moment(self, across: int) -> object:
        """The part of the present that a picture of so many cells shows; while it stays the same only the newest dots
        may differ.
        """
        if not self.curves:
            return None
        dot = min(self.window / max(1, 2 * across), LATEST_VALUE_S)
        return self.axes(across).end, math.floor(self.newest() / dot)

    def axes(self, across: int) -> Axes:
        """The window; it moves in steps of some cells, so that between two steps only the newest cells are drawn."""
        cell = self.window / max(1, across)
        step = cell * max(1, min(across // MIN_STEPS, math.ceil(PACE_S / cell)))
        if self.paused_at is not None:
            end = math.floor(self.paused_at / cell) * cell
        else:
            end = math.ceil(self.newest() / step - 1e-6) * step
        return Axes(end - self.window, end, self.limits, self.cursor)


def change_text(change: Change) -> str:
    """A change in few words: the parameter, its value, and the reason of a refusal."""
    if not change.accepted:
        return f"✗ {change.name} {value_text(change.new)}: {change.reason}"
    return f"▲ {change.name} {value_text(change.old)} → {value_text(change.new)}"


def limits_of(text: str) -> tuple[float, float] | None:
    """Two numbers, or None for an empty text; raises `ValueError` with the remedy."""
    parts = text.replace(",", " ").replace("..", " ").split()
    if not parts:
        return None
    try:
        low, high = (float(each) for each in parts)
    except ValueError:
        raise ValueError("write two numbers, such as: 0 2.5") from None
    if not (math.isfinite(low) and math.isfinite(high) and low < high):
        raise ValueError("the first number must be the smaller one")
    if not math.isfinite(high - low):
        raise ValueError("the two numbers are too far apart")
    return low, high


MIN_SPAN, MAX_SPAN = 1e-9, 1e12
"""The least span of the value axis, as a share of its values, and the greatest one."""


def zoomed(limits: tuple[float, float], value: float | None, factor: float) -> tuple[float, float]:
    """Limits of `factor` times the span, with a value at its place; the same limits where that is too little or much.

    Without a value within the limits, their middle stays.
    """
    low, high = limits
    at = value if value is not None and low <= value <= high else (low + high) / 2
    found = at - (at - low) * factor, at + (high - at) * factor
    span = found[1] - found[0]
    return found if MIN_SPAN * max(1.0, abs(at)) <= span <= MAX_SPAN else limits


def wrong_limits(text: str) -> str:
    """The problem with typed limits; empty if there is none."""
    try:
        limits_of(text)
    except ValueError as error:
        return str(error)
    return ""
