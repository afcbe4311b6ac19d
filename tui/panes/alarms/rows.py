"""The rows of the alarms pane: whether a condition is true, its name, its value, and how often it has become true."""

from __future__ import annotations

from dataclasses import dataclass

from bot_console.tui.console.filter_syntax import Query
from bot_console.tui.console.model import RateCheck
from bot_console.tui.panes.alarms.alarm import Alarm
from bot_console.tui.text.counted import counted
from bot_console.tui.text.figures import age_text
from bot_console.tui.text.sanitize import cut, cut_name, sanitize
from bot_console.tui.widgets.item_list import ItemList
from rich.cells import cell_len
from rich.segment import Segment
from textual.events import Click
from textual.message import Message

STATES = {True: ("✗", "active", "error"), False: ("○", "quiet", "good"), None: ("?", "unknown", "warn")}
MAX_NAME_CELLS, STATE_CELLS, AGE_CELLS = 24, 11, 8
"""Maximum cells of the name, and cells of the state and of the time since it changed."""

NO_VALUE = "no value yet"
SUGGESTED_VALUE = 6 + len(NO_VALUE)
"""Cells for marks, gaps and the value of a suggestion."""


@dataclass(frozen=True, slots=True)
class Row:
    """An alarm, an expected rate or a suggested alarm as shown."""

    name: str
    condition: str
    bell: bool
    holds: bool | None
    age: int
    """Whole seconds since `holds` last changed."""
    times: int
    value: str
    expected: bool = False
    """Whether it is an expected rate rather than an alarm."""
    suggested: bool = False
    """Whether it is an alarm that could be added."""


def suggestion_row(alarm: Alarm) -> Row:
    """The row of a suggested alarm, with the value that its condition compares now."""
    text = alarm.text
    value = alarm.condition.compared(alarm.values)
    shown = NO_VALUE if value is None else f"now {value:.3g}"
    return Row(text.name, text.condition, False, None, 0, 0, shown, suggested=True)


def alarm_row(alarm: Alarm, now: float) -> Row:
    """The row of an alarm at a time (s) on the time axis of all series."""
    values = ", ".join(f"{alarm.values[each]:.4g}" for each in alarm.paths if each in alarm.values)
    age = max(0, int(now - alarm.since)) if alarm.holds is not None else 0
    text = alarm.text
    return Row(text.name, text.condition, text.bell, alarm.holds, age, alarm.times, alarm.problem or values)


def check_row(check: RateCheck, now: float) -> Row:
    """The row of an expected rate at a time (s since the epoch)."""
    age = max(0, int(now - check.since / 1e9)) if check.late is not None else 0
    return Row(check.topic, check.expected, False, check.late, age, check.times, check.measured, True)


class AlarmRows(ItemList[Row]):
    """One alarm per row."""

    class Pressed(Message):
        """The selected row was clicked."""

    def key(self, item: Row) -> object:
        """The name, and whether the row is an expected rate: an alarm may have the name of an expected topic."""
        return item.name, item.expected

    def matches(self, index: int, query: Query) -> bool:
        """Whether an alarm matches a filter."""
        return query.matches(f"{self.rows[index].name} {self.rows[index].condition}")

    def row(self, index: int, width: int) -> list[Segment]:
        """State, name, times, value, condition."""
        row = self.rows[index]
        if row.suggested:
            return self._suggestion(row, width)
        sign, word, style = STATES[row.holds]
        name = min(
            MAX_NAME_CELLS, max((cell_len(sanitize(each.name)) for each in self.rows), default=0), max(8, width // 3)
        )
        loud = self.row_style(style)
        segments = [
            Segment(f"{sign} {word:<{STATE_CELLS - 2}}", loud),
            Segment(cut(sanitize(row.name), name, pad=True) + "  ", loud if row.holds else self.row_style("strong")),
        ]
        if width >= 60:
            so = age_text(row.age) if row.holds is not None else ""
            segments.append(Segment(f"{so:<{AGE_CELLS}}", self.row_style("dim")))
        segments += [
            Segment(
                f"{counted(row.times, 'time') if row.times else '':<9}", loud if row.holds else self.row_style("dim")
            ),
            Segment("♪ " if row.bell else "  ", self.row_style("dim")),
            Segment(cut(sanitize(row.value), 16, pad=True) + "  "),
            Segment(sanitize(row.condition), self.row_style("dim")),
        ]
        return segments

    def _suggestion(self, row: Row, width: int) -> list[Segment]:
        """Name, condition, and the value now."""
        name = min(max(MAX_NAME_CELLS, width // 4), max(cell_len(sanitize(each.name)) for each in self.rows))
        condition = min(
            max(cell_len(sanitize(each.condition)) for each in self.rows), max(12, width - name - SUGGESTED_VALUE)
        )
        return [
            Segment("○ ", self.row_style("dim")),
            Segment(cut(sanitize(row.name), name, pad=True) + "  ", self.row_style("strong")),
            Segment(cut_name(sanitize(row.condition), condition, pad=True) + "  ", self.row_style("dim")),
            Segment(sanitize(row.value)),
        ]

    def on_click(self, event: Click) -> None:
        """Select the clicked row; post `Pressed` if it was selected already."""
        event.prevent_default()  # as in any other list
        index = event.y + self.scroll_offset.y
        if 0 <= index < self.row_count():
            chosen, self.cursor = index == self.cursor, index
            if chosen:
                self.post_message(self.Pressed())
