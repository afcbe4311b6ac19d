"""The plot's questions to the user: for curves, limits, thresholds, names and files."""

from __future__ import annotations

import re
from functools import partial
from pathlib import Path

from bot_console.tui.console.answer import Answer
from bot_console.tui.files import plot_presets
from bot_console.tui.files.plot_presets import PlotPresetError, Preset, SavedCurve
from bot_console.tui.files.save_file import NotSaved
from bot_console.tui.panes.pane import Pane
from bot_console.tui.panes.plot.formulas.formula import split_expressions
from bot_console.tui.panes.plot.thresholds import thresholds_of, thresholds_problem, thresholds_text
from bot_console.tui.panes.plot.time_window import Timeline, limits_of, limits_problem, zoom_limits
from bot_console.tui.widgets.prompt.question import Choice, Option, matching_options
from bot_console.tui.widgets.prompt.question import Line as Asked

STAMP = re.compile(r"[/.](?:nano)?sec$")
WIDTH_CELLS = 120
"""Width (cells) of the plot that is saved."""


class PlotQuestions(Pane):
    """The base of the plot pane: its curves, and the questions about them."""

    _timeline: Timeline
    _expected: dict[str, str]
    _chosen = 0
    _touched = False

    def draw(self) -> None:
        """Draw the plot."""
        raise NotImplementedError

    def fetch_samples(self, *, force: bool = False) -> None:
        """Fetch new samples, and draw if they change the picture; `force` always draws."""
        raise NotImplementedError

    @property
    def paths(self) -> list[str]:
        """The plotted paths."""
        return [each.path for each in self._timeline.curves]

    def action_add(self) -> None:
        """Ask for curves."""
        from bot_console.tui.panes.plot.formulas.suggestions import suggestions

        known = [each for each in self.console.plots.plottable() if each.isprintable()]
        self.ask(
            Choice(
                "Plot",
                lambda _: None,
                attempt=self._add_all,
                find=partial(suggestions, known),
                hint="type part of a path, or an expression such as /a/x - /b/x or mean(/a/x, 1 s)",
                empty="Nothing that can be plotted matches.",
            )
        )

    def _add_all(self, paths: str) -> str:
        return next((wrong for path in split_expressions(paths) if (wrong := self._added(path))), "")

    def add(self, path: str) -> bool:
        """Plot a path or an expression; if that is not possible, notifies why and returns False."""
        wrong = self._added(path)
        if wrong:
            self.notify(wrong, title="Not plotted", severity="warning", markup=False)
        return not wrong

    def _added(self, path: str) -> str:
        """Plot a path or an expression; returns why it cannot be plotted, or an empty text."""
        self._touched = True
        path = path.strip()
        if not path or path in self.paths:
            return ""
        answer = self._timeline.add(path)
        if answer.ok:
            self._chosen = len(self.paths) - 1
            self._hint_at_parameters(path)
        self.fetch_samples(force=True)
        return "" if answer.ok else answer.text

    def _hint_at_parameters(self, path: str) -> None:
        """If a topic such as `/parameter_events` has no numbers but stamps, notify how a parameter is plotted."""
        if not STAMP.search(path):
            return
        topics = [each.name for each in self.console.snapshot().graph.topics if path.startswith(f"{each.name}/")]
        topic = max(topics, key=len, default="")
        numbers = [each for each in self.console.plots.plottable() if topic and each.startswith(f"{topic}/")]
        if numbers and all(STAMP.search(each) for each in numbers):
            hint = f"The only numbers of {topic} are stamps. To plot a parameter, type /node:param."
            self.notify(hint, title="Only stamps", markup=False)

    def action_remove_all(self) -> None:
        """Remove all curves, including those that have not appeared."""
        self._touched = True
        self._expected.clear()
        while self.paths:
            self._timeline.remove(0)
        self._chosen = 0
        self.draw()

    def action_limits(self) -> None:
        """Ask for the limits of the value axis."""
        label = "minimum and maximum (empty: automatic)"
        self.ask(Asked(label, self._limit, text=self._limits_text(), check=limits_problem))

    def action_zoom_values(self, factor: float) -> None:
        """Zoom the value axis around the value of the chosen curve at the cursor, or its newest one."""
        from bot_console.tui.panes.plot.view import limits, visible_ranges

        timeline = self._timeline
        axes = timeline.axes(WIDTH_CELLS)
        shown = [each for each in timeline.curves if not each.right] or timeline.curves
        if not shown:
            return
        now = timeline.limits or limits([visible_ranges(each, axes, WIDTH_CELLS) for each in shown])
        chosen = timeline.curves[self._chosen]
        value = chosen.latest if axes.cursor is None else chosen.at(axes.cursor)
        timeline.limits = zoom_limits(now, value if chosen in shown else None, factor)
        self.fetch_samples(force=True)

    def _limits_text(self) -> str:
        now = self._timeline.limits
        return f"{now[0]:g} {now[1]:g}" if now else ""

    def _limit(self, text: str) -> None:
        self._timeline.limits = limits_of(text)
        self.draw()

    def action_thresholds(self) -> None:
        """Ask for the thresholds of the chosen curve."""
        if not self.paths:
            return
        curve = self._timeline.curves[self._chosen]

        def take(text: str) -> None:
            curve.thresholds = thresholds_of(text)
            self.draw()

        text = thresholds_text(curve.thresholds)
        self.ask(Asked("threshold, e.g. > 1.5 or < 0.2 (empty: none)", take, text=text, check=thresholds_problem))

    def action_export(self) -> None:
        """Ask for the file to save the samples to."""
        self.ask_file("save samples to", "plot.csv", self._save_samples)

    def action_picture(self) -> None:
        """Ask for the file to save the picture to."""
        self.ask_file("save picture to (.svg .png .html .txt)", "plot.svg", self._save_picture)

    def _save_samples(self, path: Path) -> Answer:
        from bot_console.tui.panes.plot.save import samples

        timeline = self._timeline
        count = samples(path, timeline.curves, timeline.axes(WIDTH_CELLS), timeline.wall)
        return Answer(True, f"{count} samples saved to {path}")

    def _save_picture(self, path: Path) -> Answer:
        from bot_console.tui.panes.plot.save import picture

        timeline = self._timeline
        picture(path, timeline.curves, timeline.marks, timeline.axes(WIDTH_CELLS), timeline.wall)
        return Answer(True, f"picture saved to {path}")

    def action_keep(self) -> None:
        """Ask for a name under which the current curves are saved."""
        if self.paths:
            self.ask(Asked("save these curves as", self._keep, check=plot_presets.preset_name_problem))
        else:
            self.notify("There are no curves to save.")

    def _keep(self, name: str) -> None:
        timeline = self._timeline
        curves = [SavedCurve(each.path, each.right, thresholds_text(each.thresholds)) for each in timeline.curves]
        try:
            preset = Preset(tuple(curves), timeline.window, self._limits_text(), timeline.against)
            path = plot_presets.save_preset(name, preset)
        except NotSaved as error:
            self.report(Answer(False, f"not saved: {error}"))
        else:
            self.report(Answer(True, f"curves saved in {path}; p shows them again"))

    def action_kept(self) -> None:
        """Ask which saved curves to show."""
        names = plot_presets.preset_names()
        if not names:
            self.notify("No curves have been saved; w saves those shown.")
            return

        find = partial(matching_options, [Option(each) for each in names])
        self.ask(Choice("Curves", self.show_kept, find=find, hint="name", empty="No saved curves match."))

    def show_kept(self, name: str) -> None:
        """Replace the current curves with those saved under a name."""
        timeline = self._timeline
        try:
            preset = plot_presets.read_preset(name)
            limits = limits_of(preset.limits)
            thresholds = {each.curve: thresholds_of(each.thresholds) for each in preset.curves}
        except (PlotPresetError, ValueError) as error:
            self.report(Answer(False, str(error)))
            return
        self.action_remove_all()
        timeline.set_window(preset.window)
        timeline.limits, timeline.against = limits, preset.against
        for each in preset.curves:
            if self.add(each.curve):
                curve = timeline.curves[-1]
                curve.right, curve.thresholds = each.right, thresholds[each.curve]
        self.draw()
