"""The screen of a running tuning: its progress, the scores as a curve and a table, and actions for a setting."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import ClassVar

import numpy as np
from bot_console.tui import keymap
from bot_console.tui.terminal.dimmed_screen import DimmedScreen
from bot_console.tui.text.counted import counted
from bot_console.tui.text.sanitize import cut
from bot_console.tui.text.value_text import value_text
from bot_console.tui.tuning.job import Progress, SettingResult
from bot_console.tui.tuning.port import Tuning
from bot_console.tui.tuning.specification import TuningSpecification
from bot_console.tui.tuning.tunable import Setting
from bot_console.tui.widgets.box import Box
from bot_console.tui.widgets.braille import BrailleCanvas
from bot_console.tui.widgets.prompt.line import Prompt, find_open_prompt
from bot_console.tui.widgets.prompt.question import Line
from bot_console.tui.widgets.row_list import RowList
from bot_console.tui.widgets.static_text import StaticText
from rich.segment import Segment
from rich.text import Text
from textual.app import ComposeResult
from textual.binding import BindingType

POLLS_PER_S = 4.0
"""How often per second the progress is polled."""
CURVE_ROWS = 5
"""Lines of the curve."""
BAR_CELLS = 24
"""Cells of the progress bar."""
HINT = "Enter Apply · S Save as profile · Esc Close"


class SettingRows(RowList):
    """One setting per line, best first."""

    def __init__(self, specification: TuningSpecification) -> None:
        super().__init__()
        self._specification = specification
        self.rows: tuple[SettingResult, ...] = ()
        self.first: SettingResult | None = None
        """The result of the setting from before the tuning."""

    def row_count(self) -> int:
        """The number of evaluated settings."""
        return len(self.rows)

    def row(self, index: int, width: int) -> list[Segment]:
        """Score, values, collisions and problem."""
        each = self.rows[index]
        dim = self.row_style("dim")
        warn = self.row_style("warn")
        strong = self.row_style("strong")
        score = f"{each.score:9.3f}" if math.isfinite(each.score) else "   failed"
        segments = [Segment(f"{score}  ", strong if index == 0 else None)]
        values = (value_text(value) for value in each.setting)
        segments += [Segment(f"{value:>{self.column}}  ") for value in values]
        if self.first is not None and each.setting == self.first.setting:
            segments.append(Segment("as it is now  ", dim))
        if each.collisions:
            segments.append(Segment(f"{counted(each.collisions, 'collision')}  ", warn))
        if each.problem:
            segments.append(Segment(each.problem, warn))
        return segments

    @property
    def column(self) -> int:
        """The column width of the values in cells: that of the longest name, within limits."""
        return min(18, max(6, *(len(each.name) for each in self._specification.tunables)))

    def head(self) -> str:
        """The column headings."""
        names = (f"{cut(each.name, self.column):>{self.column}}  " for each in self._specification.tunables)
        return f"{'score':>9}  " + "".join(names)


class TuningScreen(DimmedScreen):
    """Shows the progress of a tuning; closing it ends the runs."""

    BINDINGS: ClassVar[list[BindingType]] = [*keymap.bindings("tuning")]
    AUTO_FOCUS = ""
    DEFAULT_CSS = """
    TuningScreen { align: center middle; }
    TuningScreen Box { width: 94%; max-width: 120; height: 90%; }
    TuningScreen #tuning-curve { height: 5; color: $primary; }
    """

    def __init__(self, specification: TuningSpecification, tuning: Tuning, take: Callable[[Setting], None]) -> None:
        """Create the screen; `take` is called with the setting chosen for the running system."""
        super().__init__()
        self._specification = specification
        self._tuning = tuning
        self._take = take
        self._progress: Progress | None = None
        self._moved = False
        self._leaving = False

    def compose(self) -> ComposeResult:
        """Progress, curve, table, state, and a line for a name."""
        names = ", ".join(each.name for each in self._specification.tunables)
        with Box() as box:
            box.border_title = Text(f"Tune {names} for {self._specification.score.text}")
            box.border_subtitle = HINT
            yield StaticText(id="tuning-progress")
            yield StaticText(id="tuning-curve")
            yield StaticText(id="tuning-head")
            yield SettingRows(self._specification)
            yield StaticText(id="tuning-state")
            yield Prompt(id="tuning-prompt")

    @property
    def _list(self) -> SettingRows:
        return self.query_one(SettingRows)

    def on_mount(self) -> None:
        """Focus the table."""
        self._list.focus()
        self.query_one("#tuning-head", StaticText).show_text(self._list.head())
        self.set_interval(1.0 / POLLS_PER_S, self.poll)
        self.call_after_refresh(self.poll)

    def check_action(self, action: str, parameters: tuple[object, ...]) -> bool | None:
        """Disable the keys of the table while a name is typed."""
        return find_open_prompt(self) is None and super().check_action(action, parameters)

    def poll(self) -> None:
        """Show the progress, if it has changed."""
        progress = self._tuning.progress
        if progress is self._progress:
            return
        self._progress = progress
        shown = self._list
        chosen = shown.rows[shown.cursor].setting if self._moved and shown.cursor < len(shown.rows) else None
        shown.rows = tuple(sorted(progress.rows, key=lambda each: -each.score))
        shown.first = progress.rows[0] if progress.rows else None
        shown.rows_changed()
        if chosen is not None:
            shown.cursor = next((index for index, each in enumerate(shown.rows) if each.setting == chosen), 0)
        self.query_one("#tuning-progress", StaticText).show_text(progress_text(progress))
        curve = self.query_one("#tuning-curve", StaticText)
        curve.show_text(Text("\n".join(curve_lines(progress.rows, max(10, curve.size.width), CURVE_ROWS))))
        self._show_text()

    def _show_text(self, text: str = "") -> None:
        progress = self._progress
        self._leaving = False
        self.query_one("#tuning-state", StaticText).show_text(text or (verdict(progress) if progress else ""))

    def on_row_list_moved(self, event: RowList.Moved) -> None:
        """Keep the cursor on a row that the user has chosen when better ones arrive."""
        event.stop()
        self._moved = event.index != 0

    @property
    def _chosen(self) -> SettingResult | None:
        shown = self._list
        return shown.rows[shown.cursor] if shown.cursor < len(shown.rows) else None

    def action_take(self) -> None:
        """Apply the setting at the cursor to the running system."""
        chosen = self._chosen
        if chosen is None:
            self._show_text("There are no results yet.")
        elif chosen.problem:
            self._show_text(f"This setting failed: {chosen.problem}")
        else:
            self._tuning.stop()
            self.dismiss()
            self._take(chosen.setting)

    def action_save(self) -> None:
        """Ask for a name and save the setting at the cursor as a profile."""
        chosen = self._chosen
        if chosen is None:
            self._show_text("There are no results yet.")
            return

        def save(name: str) -> None:
            self._show_text(self._tuning.save(name.strip(), chosen.setting).text)

        self.query_one(Prompt).ask(Line("save as profile", save, text="tuned"))

    def action_leave(self) -> None:
        """Close the screen and end the runs; if some are unfinished, only when asked a second time."""
        if self._progress is None or self._progress.ended or self._leaving:
            self._tuning.stop()
            self.dismiss()
            return
        self._show_text("Runs are unfinished: esc again ends them. T with the same answers continues from there.")
        self._leaving = True


def progress_text(progress: Progress) -> str:
    """A progress bar, and the remaining time."""
    if not progress.runs:
        return progress.problem or "preparing the runs ..."
    full = round(BAR_CELLS * progress.done / progress.runs)
    text = f"{'█' * full}{'░' * (BAR_CELLS - full)}  {progress.done} of {progress.runs} runs"
    if progress.ended:
        return f"{text}, {progress.problem or 'done'}"
    left = progress.left
    return text if left is None else f"{text}, about {_minutes(left)} left"


def _minutes(seconds: float) -> str:
    whole = math.ceil(seconds)
    return f"{whole} s" if whole < 100 else f"{whole // 60} min {whole % 60} s"


def verdict(progress: Progress) -> str:
    """A text on the best score, and whether it is better on other seeds, too."""
    best = progress.best
    if best is None or not progress.rows:
        return progress.problem
    first = progress.rows[0]
    text = f"now {first.score:.3f}, best {best.score:.3f}"
    if progress.held_out:
        before, after = progress.held_out
        text += f"; on {counted(len(after.scores), 'other seed')} {before.score:.3f} → {after.score:.3f}"
        if after.score <= before.score and best is not first:
            text += ": not better there"
    elif progress.ended:
        text += f"; {progress.problem}" if progress.problem else ""
    return text


def curve_lines(rows: Sequence[SettingResult], width: int, height: int) -> list[str]:
    """The scores of the settings in order as dots, and the best so far as a line."""
    canvas = BrailleCanvas(width, height)
    scores = np.array([each.score for each in rows], float)
    finite = scores[np.isfinite(scores)]
    if not len(finite):
        return canvas.rows()
    low, high = float(finite.min()), float(finite.max())
    across, down = canvas.size
    x = np.arange(len(scores)) * (across - 1) / max(1, len(scores) - 1)
    y = (high - scores) / ((high - low) or 1.0) * (down - 1)
    seen = np.isfinite(scores)
    canvas.points(x[seen], y[seen])
    best = np.minimum.accumulate(np.where(seen, y, down - 1.0))
    for at in range(1, len(best)):
        canvas.line(float(x[at - 1]), float(best[at - 1]), float(x[at]), float(best[at - 1]))
        canvas.line(float(x[at]), float(best[at - 1]), float(x[at]), float(best[at]))
    return canvas.rows()
