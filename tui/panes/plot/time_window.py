"""The parts of a plot: curves, markers, and the time window."""

from __future__ import annotations

import math
from collections.abc import Sequence

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.model import Change
from bot_console.tui.console.plot.port import Plots
from bot_console.tui.panes.plot.curves import Curve
from bot_console.tui.panes.plot.formulas.computed import ComputedCurve
from bot_console.tui.panes.plot.formulas.formula import Formula, parse_formula
from bot_console.tui.panes.plot.thresholds import first_crossed
from bot_console.tui.panes.plot.view import Axes, Mark
from bot_console.tui.text.value_text import value_text

WINDOWS_S = (1.0, 2.0, 5.0, 10.0, 30.0, 60.0, 120.0, 300.0, 600.0)
"""The lengths (s) that the time window can have."""

DEFAULTS = ("/odom/twist.twist.linear.x", "/robot_navigator:max_speed")
"""The curves plotted by default, as endings of paths."""

COLOURS = 6

PACE_S = 0.5
"""Seconds for which the window stands still between two steps, unless `MIN_STEPS` requires shorter ones."""

LATEST_VALUE_S = 0.3
"""Seconds after which the newest value is shown even if it falls into the same dot as the previous one."""

MIN_STEPS = 20
"""Minimum number of steps in which the window moves by its own width."""


class Timeline:
    """Curves over a time window that ends at the newest sample, or stands still while paused."""

    def __init__(self, plots: Plots) -> None:
        self._plots = plots
        self.curves: list[Curve] = []
        self.against = ""
        """The path of the curve against which the others are drawn; empty for time."""
        self.by_header = False
        """Whether samples are placed by the times in message headers instead of their arrival times."""
        self._sources: dict[str, Curve] = {}
        self._uses: dict[str, tuple[str, ...]] = {}
        """The paths whose samples each curve needs, by the path of the curve."""
        self.marks: list[Mark] = []
        self.window = 30.0
        self.limits: tuple[float, float] | None = None
        self.paused_at: float | None = None
        self.new_samples = 0
        self.cursor: float | None = None
        """The moment at the cursor (s, on the time axis); None without a cursor."""

    def add(self, text: str) -> Answer:
        """Add a curve of a path or an expression in the first free colour; the answer says why it was refused."""
        found: Formula | str = text
        if text not in self._plots.plottable():
            try:
                found = parse_formula(text)
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
            curve = ComputedCurve(found, colour, sources)
        self.curves.append(curve)
        self._uses[curve.path] = paths
        return Answer(True, text)

    def _source(self, path: str) -> Curve:
        found = self._sources.get(path)
        if found is None:
            found = self._sources[path] = Curve(path, by_header=self.by_header)
        return found

    def remove(self, at: int) -> None:
        """Remove a curve, and its samples unless another curve needs them."""
        curve = self.curves.pop(at)
        self.against = "" if self.against == curve.path else self.against
        self._forget(self._uses.pop(curve.path))

    def _forget(self, paths: Sequence[str]) -> None:
        needed = {path for paths in self._uses.values() for path in paths}
        for path in paths:
            if path not in needed:
                self._sources.pop(path, None)
                self._plots.unwatch(path)

    def place_samples(self, by_header: bool) -> None:
        """Place samples by the times in message headers, or by their arrival times."""
        self.by_header = by_header
        for each in self._sources.values():
            each.by_header = by_header

    def clear(self) -> None:
        """Discard all samples and marks."""
        for each in self._sources.values():
            each.clear()
        self.marks.clear()

    def fetch_samples(self) -> bool:
        """Fetch new samples; returns whether anything has to be drawn."""
        before = sum(each.cursor for each in self._sources.values())
        changed = any([each.fetch_samples(self._plots) for each in self._sources.values()])
        for each in self.curves:
            if each.path not in self._sources:
                each.fetch_samples(self._plots)
        if self.paused_at is not None:
            self.new_samples += sum(each.cursor for each in self._sources.values()) - before
        return changed

    def set_window(self, seconds: float) -> None:
        """Set the window to the available length nearest to `seconds`."""
        self.window = min(WINDOWS_S, key=lambda each: abs(each - seconds))

    def marks_of(self, changes: Sequence[Change]) -> None:
        """Mark parameter changes and refusals."""
        if not changes:
            self.marks = []
            return

        self.marks = [Mark(self._plots.time(each.stamp), not each.accepted, change_text(each)) for each in changes]

    def show_moment(self, stamp: int | None) -> None:
        """Pause the window so that it shows a moment (ns since the epoch); for None, resume."""
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
        """The time of the next mark after the cursor, or before it for a negative step; None if there is none."""
        times = sorted({each.time for each in self.marks})
        at = self.cursor if self.cursor is not None else self.newest()
        later = [each for each in times if (each > at if step > 0 else each < at)]
        return None if not later else later[0] if step > 0 else later[-1]

    def pause(self) -> None:
        """Pause or resume the window."""
        self.paused_at = self.newest() if self.paused_at is None else None
        self.new_samples = 0

    def stamp_of(self, time: float) -> int:
        """The moment (ns since the epoch) of a time on the axis."""
        return round((time - self._plots.time(0)) * 1e9)

    def wall(self, time: float) -> float:
        """The moment (s since the epoch) of a time on the axis."""
        return self.stamp_of(time) / 1e9

    def beside_cursor(self, step: int, across: int) -> int:
        """The moment (ns since the epoch) `step` cells from the cursor, or from the newest sample without a cursor."""
        axes = self.axes(across)
        at = self.cursor if self.cursor is not None else min(self.newest(), axes.end)
        return self.stamp_of(at + step * self.window / max(1, across))

    def crossed(self) -> list[str]:
        """Texts on the curves whose value, at the cursor or else now, is beyond one of their thresholds."""
        found: list[str] = []
        for each in self.curves:
            value = each.latest if self.cursor is None else each.at(self.cursor)
            over = first_crossed(each.thresholds, value)
            if over is not None:
                found.append(f"! {each.path} {over.text}")
        return found

    def shift(self, step: int) -> None:
        """Move a paused window by tenths of its length."""
        if self.paused_at is not None:
            self.paused_at += step * self.window / 10

    def newest(self) -> float:
        """The time of the newest sample of a topic; now if there are only parameters."""
        streams = [end for each in self.curves if not each.steps and (end := each.end) is not None]
        return max(streams) if streams else self._plots.time()

    def moment(self, across: int) -> object:
        """A token for the time shown by a picture of `across` cells; while it is equal, only the newest dots differ."""
        if not self.curves:
            return None
        dot = min(self.window / max(1, 2 * across), LATEST_VALUE_S)
        return self.axes(across).end, math.floor(self.newest() / dot)

    def axes(self, across: int) -> Axes:
        """The window; it moves in steps of several cells, so that between two steps only the newest cells are drawn."""
        cell = self.window / max(1, across)
        step = cell * max(1, min(across // MIN_STEPS, math.ceil(PACE_S / cell)))
        if self.paused_at is not None:
            end = math.floor(self.paused_at / cell) * cell
        else:
            end = math.ceil(self.newest() / step - 1e-6) * step
        return Axes(end - self.window, end, self.limits, self.cursor)


def change_text(change: Change) -> str:
    """A change in a few words: the parameter, its value, and the reason of a refusal."""
    if not change.accepted:
        return f"✗ {change.name} {value_text(change.new)}: {change.reason}"
    return f"▲ {change.name} {value_text(change.old)} → {value_text(change.new)}"


def limits_of(text: str) -> tuple[float, float] | None:
    """Parse two limits; None for an empty text. Raises `ValueError` that says how to write them."""
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
"""The minimum span of the value axis, as a share of its values, and the maximum span."""


def zoom_limits(limits: tuple[float, float], value: float | None, factor: float) -> tuple[float, float]:
    """Limits with `factor` times the span, in which `value` keeps its place, or the middle if it is outside or None.

    Returns the same limits if the span would become too small or too large.
    """
    low, high = limits
    at = value if value is not None and low <= value <= high else (low + high) / 2
    found = at - (at - low) * factor, at + (high - at) * factor
    span = found[1] - found[0]
    return found if MIN_SPAN * max(1.0, abs(at)) <= span <= MAX_SPAN else limits


def limits_problem(text: str) -> str:
    """The problem with typed limits; empty if there is none."""
    try:
        limits_of(text)
    except ValueError as error:
        return str(error)
    return ""
