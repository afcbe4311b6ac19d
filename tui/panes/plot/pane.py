"""The plot pane: numbers over time, of topics' fields and of parameters."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any, ClassVar

from bot_console.tui import keymap
from bot_console.tui.console.model import ConsoleSnapshot, JournalState
from bot_console.tui.console.protocol import Answer
from bot_console.tui.format import clock_text, cut
from bot_console.tui.opening import matching
from bot_console.tui.panes.pane import Pane
from bot_console.tui.panes.plot.parts import DEFAULTS, WINDOWS, Timeline, limits_of, wrong_limits
from bot_console.tui.panes.plot.responses import Responses, wrong_formula
from bot_console.tui.widgets.picture import Line, Picture
from bot_console.tui.widgets.prompt.line import Prompt
from bot_console.tui.widgets.prompt.question import Line as Asked
from textual.app import ComposeResult

LEAST_FRAME = 8
"""Lines from which on a frame with axes leaves room for the trace."""

SCORED = ("rise", "overshoot", "settling", "error")
"""The figures of a response that a score may name."""

EMPTY = "No curves. Press a and name one: /topic/field, or /node:parameter."


class PlotPane(Pane):
    """Curves over time."""

    TITLE = "Plot"
    HELP = (
        "Numbers over time: a field of a topic such as /odom/twist.twist.linear.x or /scan/ranges[0], or a parameter\n"
        "such as /robot_navigator:max_speed. ▲ on the time axis marks a changed parameter, ✗ a refused one. A value\n"
        "that is not finite leaves a gap. Space pauses the picture; left and right then move through time. , and . go\n"
        "from mark to mark and say what was changed there. o lays the responses to set A and set B over each other,\n"
        "with rise time (10 to 90 %), overshoot, settling time (5 %) and steady error against the reference."
    )
    BINDINGS = keymap.bindings("plot")
    SCOPES: ClassVar[tuple[str, ...]] = ()

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._timeline = Timeline(self.console)
        self._responses = Responses(self.console)
        self._chosen = 0
        self._strips = False
        self._touched = False
        self._expected: list[str] = []
        self._journal: JournalState | None = None
        self._graph: object = None
        self._parameters: object = None

    def compose(self) -> ComposeResult:
        """The picture, the legend, a prompt."""
        yield Picture(id="plot-picture")
        yield Picture(id="plot-legend")
        yield Prompt(id="plot-prompt")
        self.can_focus = True

    def focus_target(self) -> None:
        """The pane itself takes the keys."""
        self.focus()

    @property
    def paths(self) -> list[str]:
        """What is plotted."""
        return [each.path for each in self._timeline.curves]

    def show(self, snapshot: ConsoleSnapshot) -> None:
        """Plot the speed when there is one and nothing else was asked for; mark new changes."""
        known = (snapshot.graph, snapshot.parameters)
        if not self._touched and (known[0] is not self._graph or known[1] is not self._parameters):
            self._graph, self._parameters = known
            self._add_defaults()
        if self._expected:
            self._take_expected(snapshot)
        if snapshot.journal is not self._journal:
            self._journal = snapshot.journal
            changes = self.console.changes()
            self._timeline.marks_of(changes)
            self._responses.read(changes)
        self.tick(force=True)

    def _add_defaults(self) -> None:
        known = self.console.plottable()
        for wanted in DEFAULTS:
            path = next((each for each in known if each.endswith(wanted)), None)
            if path is not None and path not in self.paths:
                self._timeline.add(path)

    def expect(self, wanted: Sequence[str]) -> None:
        """Plot these topics or paths in place of the defaults, each as soon as it is there."""
        if not self._touched:
            self.action_remove_all()
        self._touched = True
        self._expected += [each for each in wanted if each not in self._expected]

    def _take_expected(self, snapshot: ConsoleSnapshot) -> None:
        known = self.console.plottable()
        topics = {each.name for each in snapshot.graph.topics}
        for wanted in tuple(self._expected):
            found = matching(wanted, known)
            if found or wanted in topics:
                self._expected.remove(wanted)
                for path in found or [wanted]:  # of which the latter is refused with the reason
                    self.add(path)

    def tick(self, force: bool = False) -> None:
        """Fetch new samples and draw, if there are any and the pane is seen."""
        if not self.display or not self.is_mounted:
            return
        changed = self._timeline.take_in()
        if changed or force:
            self.draw()

    def draw(self) -> None:
        """Draw the picture and its legend, and say which window is shown."""
        picture, legend = self.query_one("#plot-picture", Picture), self.query_one("#plot-legend", Picture)
        curves = self._timeline.curves
        width, height = picture.size
        strips = self._strips or self.size.height < LEAST_FRAME + len(curves)
        below = 0 if strips else min(len(curves), 6)
        if legend.styles.height is None or legend.styles.height.value != below:
            legend.styles.height = below
        self.caption(self._status())
        if width < 16 or height < 2:
            return
        if not curves:
            picture.set_lines([()] * ((height - 1) // 2) + [((cut(EMPTY, width).center(width), "dim"),)])
            return
        if self._responses.shown:
            picture.set_lines(self._responses.draw(curves, self._chosen, self._timeline.window, (width, height)))
        else:
            picture.set_lines(self._lines(width, height, strips))
        if not strips:
            from bot_console.tui.panes.plot.view import legend as line

            axes = self._timeline.axes(width)
            first = max(0, self._chosen - 5)
            legend.set_lines(
                [line(each, axes, width, at == self._chosen) for at, each in enumerate(curves)][first : first + 6]
            )

    def _lines(self, width: int, height: int, strips: bool) -> Sequence[Line]:
        # NumPy is imported after the first frame: it is a third of the start-up time.
        from bot_console.tui.panes.plot import view as plot_view

        timeline = self._timeline
        axes = timeline.axes(width if strips else width - plot_view.LABEL)
        if strips:
            return plot_view.strips(timeline.curves, axes, width, height, self._chosen)
        return plot_view.framed(timeline.curves, timeline.marks, axes, width, height)

    def time_moved(self, stamp: int | None) -> None:
        """Show another moment, and what was changed then."""
        self._timeline.look_at(stamp)
        if self.display and self.is_mounted:
            self.draw()

    def action_mark(self, step: int) -> None:
        """Go to the next changed parameter on the time axis, or back to the one before."""
        time = self._timeline.next_mark(step)
        if time is None:
            self.notify("No further change of a parameter is marked.")
            return
        stamps = {self.console.plot_time(each.stamp): each.stamp for each in self.console.changes()}
        self.time_cursor.move(stamps.get(time), self)
        self.time_moved(stamps.get(time))

    def action_now(self) -> None:
        """Look at what is now again."""
        self.time_cursor.move(None, self)
        self.time_moved(None)

    def _at_cursor(self) -> str:
        """What was changed at the moment that is looked at."""
        timeline, across = self._timeline, self.query_one("#plot-picture", Picture).size.width
        marks = timeline.axes(across).marks_at_cursor(timeline.marks, across)
        stamp = self.time_cursor.stamp
        return "  ".join([f"◆ {clock_text(stamp)}" if stamp is not None else "◆", *(each.text for each in marks)])

    def action_responses(self) -> None:
        """The responses to set A and set B over each other, or the curves again."""
        self._responses.shown = not self._responses.shown
        self.draw()

    def action_reference(self) -> None:
        """Take the chosen curve for what a response should follow, or not any more."""
        path = self.paths[self._chosen] if self.paths else ""
        self._responses.reference = "" if path == self._responses.reference else path
        self.draw()

    def action_score(self) -> None:
        """Ask for a score of responses."""
        label = f"score, of {', '.join(SCORED)} (such as overshoot + 0.5*settling)"
        self.ask(Asked(label, self._score_is, text=self._responses.formula, check=wrong_formula))

    def _score_is(self, formula: str) -> None:
        self._responses.formula = formula.strip()
        self.draw()

    def _status(self) -> str:
        timeline = self._timeline
        if self._responses.shown:
            return self._responses.caption(timeline.curves, self._chosen)
        parts = [f"{timeline.window:g} s"]
        if timeline.cursor is not None:
            parts.append(self._at_cursor())
        if timeline.paused_at is not None:
            parts.append("paused" + (f", {timeline.new_samples} new" if timeline.new_samples else ""))
        if timeline.limits:
            parts.append(f"y {timeline.limits[0]:g} .. {timeline.limits[1]:g}")
        if self._expected:
            parts.append(f"waits for {', '.join(self._expected)}")
        return " · ".join(parts)

    def on_picture_resized(self, event: Picture.Resized) -> None:
        """Draw for the new size."""
        event.stop()
        self.draw()

    def action_add(self) -> None:
        """Ask for a path."""
        known = [each for each in self.console.plottable() if each.isprintable()]
        self.ask(Asked("plot", self._add_all, text="/", suggestions=known))

    def _add_all(self, paths: str) -> None:
        from bot_console.tui.panes.plot.formula import split

        for path in split(paths):
            self.add(path)

    def add(self, path: str) -> None:
        """Plot a path, or say why not."""
        self._touched = True
        path = path.strip()
        if not path or path in self.paths:
            return
        answer = self._timeline.add(path)
        if answer.ok:
            self._chosen = len(self.paths) - 1
        else:
            self.notify(answer.text, title="Not plotted", severity="warning", markup=False)
        self.tick(force=True)

    def action_remove(self) -> None:
        """Remove the chosen curve."""
        self._touched = True
        if self.paths:
            self._drop(self._chosen)
            self._chosen = max(0, min(self._chosen, len(self.paths) - 1))
        self.draw()

    def _drop(self, at: int) -> None:
        self._timeline.remove(at)

    def action_remove_all(self) -> None:
        """Remove all curves."""
        self._touched = True
        while self.paths:
            self._drop(0)
        self._chosen = 0
        self.draw()

    def action_pause(self) -> None:
        """Hold the picture, or go on."""
        self._timeline.pause()
        self.draw()

    def action_window(self, step: int) -> None:
        """Show more of the past, or less."""
        at = WINDOWS.index(self._timeline.window) + step
        self._timeline.window = WINDOWS[max(0, min(at, len(WINDOWS) - 1))]
        self.draw()

    def action_shift(self, step: int) -> None:
        """Move through time, which pauses."""
        if self._timeline.paused_at is None:
            self._timeline.pause()
        self._timeline.shift(step)
        self.draw()

    def action_choose(self, step: int) -> None:
        """Choose another curve."""
        self._chosen = max(0, min(self._chosen + step, len(self.paths) - 1))
        self.draw()

    def action_form(self) -> None:
        """Framed plot, or strips."""
        self._strips = not self._strips
        self.draw()

    def action_clear(self) -> None:
        """Forget what has been drawn."""
        self._timeline.clear()
        self.draw()

    def action_limits(self) -> None:
        """Ask for the limits of the values."""
        now = self._timeline.limits
        text = f"{now[0]:g} {now[1]:g}" if now else ""
        label = "least and greatest value (empty: automatic)"
        self.ask(Asked(label, self._limit, text=text, check=wrong_limits))

    def _limit(self, text: str) -> None:
        self._timeline.limits = limits_of(text)
        self.draw()

    def action_export(self) -> None:
        """Ask where the samples go."""
        self.ask_file("save samples to", "plot.csv", self._save_samples)

    def action_picture(self) -> None:
        """Ask where the picture goes."""
        self.ask_file("save picture to (.txt .html)", "plot.html", self._save_picture)

    def _save_samples(self, path: Path) -> Answer:
        from bot_console.tui.panes.plot.save import samples

        return Answer(True, f"{samples(path, self._timeline.curves)} samples saved to {path}")

    def _save_picture(self, path: Path) -> Answer:
        from bot_console.tui.panes.plot.save import picture

        picture(path, self._timeline.curves, self._timeline.axes(120))
        return Answer(True, f"picture saved to {path}")
