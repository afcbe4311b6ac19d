"""The overlaid responses to set A and set B, drawn in place of the plot, with their figures."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from dataclasses import dataclass, field

from bot_console.tui.console.model import Change
from bot_console.tui.console.plot.port import Plots
from bot_console.tui.panes.plot.curves import Curve
from bot_console.tui.panes.plot.step_response import Figures, Response, figures, figures_text, moments, response, score
from bot_console.tui.panes.plot.view import Axes, framed_plot
from bot_console.tui.text.sanitize import sanitize
from bot_console.tui.widgets.picture import Line

HOW = "No responses yet: mark values in the Parameters pane (m); there, A sends set B, and A again sends set A."


@dataclass
class Responses:
    """Compares the responses of a curve to the two sets, optionally with a reference curve and a scoring formula."""

    plots: Plots
    shown: bool = False
    reference: str = ""
    """The path of the curve that the response should follow; empty if there is none."""
    formula: str = ""
    _moments: dict[str, int] = field(default_factory=dict[str, int])

    def read(self, changes: Sequence[Change]) -> None:
        """Find out when the sets were last sent."""
        self._moments = moments(changes)

    def of(self, curve: Curve, window: float) -> list[Response]:
        """The responses of a curve, each for `window` seconds or until the other set was sent."""
        starts = {name: self.plots.time(stamp) for name, stamp in self._moments.items()}
        found: list[Response] = []
        for name, start in sorted(starts.items()):
            later = [each for each in starts.values() if each > start]
            end = min([start + window, *later])
            one = response(name, *curve.samples(), start, end)
            if one is not None:
                found.append(one)
        return found

    def draw(self, curves: Sequence[Curve], chosen: int, window: float, size: tuple[int, int]) -> list[Line]:
        """Draw both responses, aligned at the moments of their changes, and a line of figures for each."""
        width, height = size
        found = self.of(curves[chosen], window) if chosen < len(curves) else []
        if not found:
            how = textwrap.wrap(HOW, max(1, width))
            return [()] * max(0, (height - len(how)) // 2) + [((each.center(width), "dim"),) for each in how]
        drawn = [Curve(each.name, at, each.times, each.values) for at, each in enumerate(found)]
        axes = Axes(0.0, max(min(window, max(float(each.times[-1]) for each in found)), 1e-3), since=True)
        lines = framed_plot(drawn, (), axes, width, max(4, height - len(found)))
        for at, each in enumerate(found):
            text = figures_text(figures(each, self._reference_value(curves, each)), self.formula)
            lines.append(((f"━ {each.name} ", f"curve-{at}"), (text, "")))
        return lines

    def _reference_value(self, curves: Sequence[Curve], of: Response) -> float | None:
        """The value of the reference at the end of a response."""
        curve = next((each for each in curves if each.path == self.reference), None)
        if curve is None:
            return None
        end = self.plots.time(self._moments[of.name]) + float(of.times[-1])
        return curve.at(end)

    def caption(self, curves: Sequence[Curve], chosen: int) -> str:
        """A text that names the curve and its reference."""
        path = curves[chosen].path if chosen < len(curves) else ""
        parts = [f"responses of {path}", f"reference {self.reference}" if self.reference else "r sets the reference"]
        return sanitize(" · ".join([*parts, f"score {self.formula}" if self.formula else "s: a score"]))


def formula_problem(text: str) -> str:
    """The problem with a score's formula; empty if there is none."""
    try:
        if text.strip():
            score(text, Figures(1.0, 1.0, 1.0, 1.0))
    except ValueError as error:
        return str(error)
    return ""
