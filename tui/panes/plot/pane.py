"""The plot pane: numbers over time, from topic fields and parameters."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import Any, ClassVar

from bot_console.tui import keymap
from bot_console.tui.arrangement.rqt_command_line import matching
from bot_console.tui.console.model import ConsoleSnapshot, JournalState
from bot_console.tui.format import clock_text
from bot_console.tui.panes.plot import view as plot_view
from bot_console.tui.panes.plot.formulas.formula import Formula, parse_formula
from bot_console.tui.panes.plot.pictures import sparklines, xy_plot
from bot_console.tui.panes.plot.questions import PlotQuestions
from bot_console.tui.panes.plot.responses import Responses, formula_problem
from bot_console.tui.panes.plot.time_window import DEFAULTS, WINDOWS_S, Timeline
from bot_console.tui.widgets.picture import Line, Picture
from bot_console.tui.widgets.placeholder import Placeholder
from bot_console.tui.widgets.prompt.line import Prompt
from bot_console.tui.widgets.prompt.question import Line as Asked
from textual.app import ComposeResult

FORMS = ("framed", "strips", "lines")

MIN_FRAME_LINES = 8
"""Minimum height (lines) at which a frame with axes leaves room for the trace."""

SCORED = ("rise", "overshoot", "settling", "error")
"""The figures of a response that a score may name."""

EMPTY = Placeholder(
    "The plot shows numbers over time; there are no curves yet.",
    (
        ("a", "Add /topic/field, or /node:parameter"),
        ("p", "Show saved curves"),
        ("9", "Topics to choose from"),
    ),
)


class PlotPane(PlotQuestions):
    """Curves over time."""

    TITLE = "Plot"
    HELP = (
        "Numbers over time: a field of a topic such as /odom/twist.twist.linear.x or min(/scan/ranges), a parameter\n"
        "such as /robot_navigator:max_speed, or an expression: /a/x - /b/x, derivative(/a/x), mean(/a/x, 1 s).\n"
        "▲ on the time axis marks a changed parameter, ✗ a refused one, ! a crossed threshold. A value that is not\n"
        "finite leaves a gap. Space pauses; c sets a cursor that left and right move. , and . go from mark to mark\n"
        "and say what was changed there. o overlays the responses to set A and set B, with rise time\n"
        "(10 to 90 %), overshoot, settling time (5 %) and steady error against the reference."
    )
    BINDINGS = keymap.bindings("plot")
    SCOPES: ClassVar[tuple[str, ...]] = ()

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._timeline = Timeline(self.console.plots)
        self._responses = Responses(self.console.plots)
        self._form = "framed"
        self._expected: dict[str, str] = {}
        """The paths that are waiting to be plotted, with the reason; empty if they just do not exist yet."""
        self._journal: JournalState | None = None
        self._graph: object = None
        self._parameters: object = None
        self._heartbeats = False
        """Whether `tick` is called; without it, each snapshot is drawn."""
        self._wanted = self._undrawn = False
        """Whether something other than samples must be drawn, and whether there are samples not drawn yet."""
        self._moment: object = None
        """`Timeline.moment` of the last drawing."""

    def compose(self) -> ComposeResult:
        """The picture, the legend, and a prompt."""
        yield Picture(id="plot-picture")
        yield Picture(id="plot-legend")
        yield Prompt(id="plot-prompt")
        self.can_focus = True

    def focus_target(self) -> None:
        """Focus the pane itself."""
        self.focus()

    def show(self, snapshot: ConsoleSnapshot) -> None:
        """Plot the default curves unless the user has chosen others; mark new parameter changes."""
        known = (snapshot.graph, snapshot.parameters)
        if known[0] is not self._graph or known[1] is not self._parameters:
            self._graph, self._parameters = known
            if not self._touched:
                self._add_defaults()
            self._take_expected(snapshot)
            self._wanted = True
        if snapshot.journal is not self._journal:
            self._journal = snapshot.journal
            changes = self.console.parameters.changes()
            self._timeline.marks_of(changes)
            self._responses.read(changes)
            self._wanted = True
        if self._wanted or not self._heartbeats:
            self.fetch_samples(force=True)

    def _add_defaults(self) -> None:
        known = self.console.plots.plottable()
        for wanted in DEFAULTS:
            path = next((each for each in known if each.endswith(wanted)), None)
            if path is not None and path not in self.paths:
                self._timeline.add(path)

    def go_to(self, name: str) -> None:
        """Plot a path."""
        self.add(name)

    def expect(self, wanted: Sequence[str]) -> None:
        """Plot these topics or paths instead of the defaults, each as soon as it exists."""
        if not self._touched:
            self.action_remove_all()
        self._touched = True
        self._expected |= {each: "" for each in wanted if each not in self._expected}
        self._graph = None  # so that the next `show` tries them even if nothing has changed

    def _take_expected(self, snapshot: ConsoleSnapshot) -> None:
        if not self._expected:
            return
        known = self.console.plots.plottable()
        topics = {each.name for each in snapshot.graph.topics}
        for wanted in tuple(self._expected):
            found = matching(wanted, known)
            if found or wanted in topics:
                del self._expected[wanted]
                for path in found or [wanted]:  # adding a topic without numbers reports why it cannot be plotted
                    self.add(path)
            elif _within(wanted, known, topics):
                answer = self._timeline.add(wanted)  # a refusal is not final: its own topic may still appear
                if answer.ok:
                    del self._expected[wanted]
                elif self._expected[wanted] != answer.text:
                    self._expected[wanted] = answer.text
                    self.report(answer)  # the frame has room for its beginning only

    def tick(self) -> None:
        """Fetch new samples; draw once the newest has moved by a dot, or no more follow."""
        self._heartbeats = True
        self.fetch_samples(force=self._wanted)

    def fetch_samples(self, *, force: bool = False) -> None:
        """Fetch new samples if the pane is visible, and draw them if that changes the picture; `force` always draws."""
        if not self.display or self.is_ending:
            return
        changed = self._timeline.fetch_samples()
        self._undrawn = self._undrawn or changed
        rests = self._undrawn and not changed
        if force or rests or self._timeline.moment(self._across()) != self._moment:
            self.draw()

    def draw(self) -> None:
        """Draw the picture and its legend, and update the caption."""
        picture, legend = self.query_one("#plot-picture", Picture), self.query_one("#plot-legend", Picture)
        curves = self._timeline.curves
        width, height = picture.size
        self._wanted = self._undrawn = False
        self._moment = self._timeline.moment(width)
        form = self._form
        if form == "framed" and self.size.height < MIN_FRAME_LINES + len(curves):
            form = "strips"
        below = min(len(curves), 6) if form == "framed" else 0
        if legend.styles.height is None or legend.styles.height.value != below:
            legend.styles.height = below
        self.caption(self._status())
        if width < 16 or height < 2:
            return
        if not curves:
            picture.show_placeholder(self._nothing())
            picture.set_lines(())
            return
        if self._responses.shown:
            picture.set_lines(self._responses.draw(curves, self._chosen, self._timeline.window, (width, height)))
        else:
            picture.set_lines(self._lines(width, height, form))
        if below:
            axes = self._timeline.axes(width)
            first = max(0, self._chosen - 5)
            shown = list(enumerate(curves))[first : first + 6]
            legend.set_lines([plot_view.legend(each, axes, width, at == self._chosen) for at, each in shown])

    def _lines(self, width: int, height: int, form: str) -> Sequence[Line]:
        timeline = self._timeline
        axes = timeline.axes(width - plot_view.LABEL_CELLS if form == "framed" else width)
        if form == "strips":
            return plot_view.strips(timeline.curves, axes, width, height, self._chosen)
        if form == "lines":
            return sparklines.sparklines(timeline.curves, axes, width, height, self._chosen)
        base = next((each for each in timeline.curves if each.path == timeline.against), None)
        if base is not None and len(timeline.curves) > 1:
            return xy_plot.draw_xy(base, timeline.curves, axes, width, height)
        return plot_view.framed_plot(timeline.curves, timeline.marks, axes, width, height)

    def time_moved(self, stamp: int | None) -> None:
        """Show the moment to which the time cursor has moved, and what was changed then."""
        self._timeline.show_moment(stamp)
        if self.display and not self.is_ending:
            self.draw()

    def action_mark(self, step: int) -> None:
        """Go to the next or the previous mark of a parameter change on the time axis."""
        time = self._timeline.next_mark(step)
        if time is None:
            self.notify("There are no more marked parameter changes.")
            return
        stamps = {self.console.plots.time(each.stamp): each.stamp for each in self.console.parameters.changes()}
        if (stamp := stamps.get(time)) is not None:
            self._inspect(stamp)

    def action_now(self) -> None:
        """Return the time cursor to now."""
        self.time_cursor.move(None, self)
        self.time_moved(None)

    def _at_cursor(self) -> str:
        """A text on the moment at the cursor, and the parameter changes there."""
        timeline, across = self._timeline, self.query_one("#plot-picture", Picture).size.width
        marks = timeline.axes(across).marks_at_cursor(timeline.marks, across)
        stamp = self.time_cursor.stamp
        return "  ".join([f"◆ {clock_text(stamp)}" if stamp is not None else "◆", *(each.text for each in marks)])

    def action_responses(self) -> None:
        """Switch between the responses to set A and set B, overlaid, and the curves."""
        self._responses.shown = not self._responses.shown
        self.draw()

    def action_reference(self) -> None:
        """Make the chosen curve the reference that a response should follow, or remove that reference."""
        path = self.paths[self._chosen] if self.paths else ""
        self._responses.reference = "" if path == self._responses.reference else path
        self.draw()

    def action_score(self) -> None:
        """Ask for a formula that scores responses."""
        label = f"score, of {', '.join(SCORED)} (such as overshoot + 0.5*settling)"
        self.ask(Asked(label, self._score_is, text=self._responses.formula, check=formula_problem))

    def _score_is(self, formula: str) -> None:
        self._responses.formula = formula.strip()
        self.draw()

    def _status(self) -> str:
        timeline = self._timeline
        if self._responses.shown:
            return self._responses.caption(timeline.curves, self._chosen)
        parts = [*timeline.crossed(), f"{timeline.window:g} s"]
        if timeline.by_header:
            parts.append("header time")
        if timeline.against:
            parts.append(f"against {timeline.against}" if len(self.paths) > 1 else "against: add a second curve")
        if timeline.cursor is not None:
            parts.append(self._at_cursor())
        if timeline.paused_at is not None:
            parts.append("paused" + (f", {timeline.new_samples} new" if timeline.new_samples else ""))
        if timeline.limits:
            parts.append(f"y {timeline.limits[0]:g} .. {timeline.limits[1]:g}")
        if self._expected:
            parts.append(f"waiting for {self._waiting()}")
        return " · ".join(parts)

    def _waiting(self) -> str:
        return ", ".join(f"{each}: {why}" if why else each for each, why in self._expected.items())

    def _nothing(self) -> Placeholder:
        """The text that is shown while there is no curve."""
        if self._expected:
            text = f"Waiting for {self._waiting()}: the curve begins with the first message."
            return Placeholder(text, (("a", "Add another curve"),))
        return EMPTY

    def on_picture_resized(self, event: Picture.Resized) -> None:
        """Draw for the new size."""
        event.stop()
        self.draw()

    def action_remove(self) -> None:
        """Remove the chosen curve; if there is none, drop what was last asked for and has not appeared."""
        self._touched = True
        if self.paths:
            self._timeline.remove(self._chosen)
            self._chosen = max(0, min(self._chosen, len(self.paths) - 1))
        elif self._expected:
            self._expected.popitem()
        self.draw()

    def action_pause(self) -> None:
        """Pause or resume the plot."""
        self._timeline.pause()
        self.draw()

    def action_window(self, step: int) -> None:
        """Make the time window longer or shorter."""
        at = WINDOWS_S.index(self._timeline.window) + step
        self._timeline.window = WINDOWS_S[max(0, min(at, len(WINDOWS_S) - 1))]
        self.draw()

    def action_cursor(self) -> None:
        """Put a cursor at the newest sample, or remove the cursor."""
        if self._timeline.cursor is None:
            self._inspect(self._timeline.beside_cursor(0, self._across()))
        else:
            self.action_now()

    def _across(self) -> int:
        return self.query_one("#plot-picture", Picture).size.width

    def _inspect(self, stamp: int) -> None:
        self.time_cursor.move(stamp, self)
        self.time_moved(stamp)

    def action_shift(self, step: int) -> None:
        """Move the cursor; without one, pause and move the window."""
        if self._timeline.cursor is not None:
            self._inspect(self._timeline.beside_cursor(step, self._across()))
            return
        if self._timeline.paused_at is None:
            self._timeline.pause()
        self._timeline.shift(step)
        self.draw()

    def action_choose(self, step: int) -> None:
        """Choose another curve."""
        self._chosen = max(0, min(self._chosen + step, len(self.paths) - 1))
        self.draw()

    def action_form(self) -> None:
        """Switch between a framed plot, a strip for each curve, and a line for each curve."""
        self._form = FORMS[(FORMS.index(self._form) + 1) % len(FORMS)]
        self.draw()

    def action_right_axis(self) -> None:
        """Move the chosen curve to the other value axis."""
        if self.paths:
            curve = self._timeline.curves[self._chosen]
            curve.right = not curve.right
            self.draw()

    def action_against(self) -> None:
        """Plot the other curves against the chosen one instead of time, or against time again."""
        path = self.paths[self._chosen] if self.paths else ""
        self._timeline.against = "" if self._timeline.against == path else path
        self.draw()

    def action_header_time(self) -> None:
        """Switch between the times in message headers and arrival times."""
        self._timeline.place_samples(by_header=not self._timeline.by_header)
        self.draw()

    def action_clear(self) -> None:
        """Clear the plot."""
        self._timeline.clear()
        self.draw()


def _within(wanted: str, known: Collection[str], topics: Collection[str]) -> bool:
    """Whether every path in an expression is plottable, or lies in an existing topic.

    The plottable paths name only the first element of an array, and nothing in arrays of messages.
    """
    try:
        formula = parse_formula(wanted)
    except ValueError:
        return False
    paths = formula.paths if isinstance(formula, Formula) else (formula,)
    return all(path in known or any(f"{path}/".startswith(f"{each}/") for each in topics) for path in paths)
