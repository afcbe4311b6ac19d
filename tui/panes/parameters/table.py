"""The table of the parameter pane: name, value, slider, and the description or the reason of a refusal."""

from __future__ import annotations

from collections.abc import Sequence

from bot_console.tui.console.filter_syntax import Query
from bot_console.tui.console.model import ChangeSource, ParameterInfo
from bot_console.tui.console.parameters.edits import ParameterEdits
from bot_console.tui.console.parameters.origin_text import SET_BY
from bot_console.tui.panes.parameters.columns import (
    GAP_CELLS,
    MARKS_CELLS,
    Measures,
    columns,
    measure,
    name_column,
    shown_value,
)
from bot_console.tui.panes.parameters.rows import Row, matches
from bot_console.tui.text.refusals import beside_row
from bot_console.tui.text.sanitize import cut, sanitize
from bot_console.tui.text.value_text import value_text
from bot_console.tui.widgets.item_list import ItemList
from rich.segment import Segment
from rich.style import Style
from textual.events import Click, MouseDown, MouseMove, MouseUp
from textual.message import Message

READ_ONLY = "read only"
"""Shown beside a value that cannot be set, if all of it fits."""


class ParameterRows(ItemList[Row]):
    """The rows of the tree."""

    class Slid(Message):
        """The slider of a parameter was clicked or dragged to a share (0 to 1) of its range."""

        def __init__(self, parameter: ParameterInfo, share: float) -> None:
            super().__init__()
            self.parameter = parameter
            self.share = share

    class Pressed(Message):
        """The selected row was clicked."""

        def __init__(self, row: Row) -> None:
            super().__init__()
            self.row = row

    def __init__(self, edits: ParameterEdits) -> None:
        super().__init__()
        self._edits = edits
        self.flashing: dict[tuple[str, str], float] = {}
        """The values that have just changed, with the times (s) until which they are highlighted."""

        self._measures = Measures()
        self.split = 0
        """The number of cells by which the user has moved the edge between names and values."""
        self._dragged = False
        self._sliding: tuple[ParameterInfo, int, int] | None = None
        """The parameter whose slider is being dragged, and the slider's first cell and its width."""
        self._slid = False
        """Whether the last press was on a slider."""

    def move_split(self, cells: int) -> None:
        """Move the edge between names and values, unless it is at its limit."""
        own = columns(self._measures, self.across, self.split)
        moved = columns(self._measures, self.across, self.split + cells)
        if moved.name != own.name:
            self.split += cells
            self.refresh()

    def on_mouse_down(self, event: MouseDown) -> None:
        """Start dragging the edge between names and values, or a slider."""
        self._sliding = self._slider_at(event.x, event.y + self.scroll_offset.y)
        self._slid = self._sliding is not None
        edge = MARKS_CELLS + columns(self._measures, self.across, self.split).name
        self._dragged = edge <= event.x < edge + GAP_CELLS and 0 <= event.y + self.scroll_offset.y < self.row_count()
        if self._dragged or self._slid:
            self.capture_mouse()

    def on_mouse_move(self, event: MouseMove) -> None:
        """Drag the edge."""
        if self._dragged and self.app.mouse_captured is self:  # pyright: ignore[reportUnknownMemberType] -- Textual's App is generic
            edge = MARKS_CELLS + columns(self._measures, self.across, self.split).name
            self.move_split(event.x - edge)

    def on_mouse_up(self, event: MouseUp) -> None:
        """Stop dragging the edge; set the value at which a slider is released, wherever the mouse has strayed to."""
        self.release_mouse()
        if self._sliding:
            (parameter, begin, cells), self._sliding = self._sliding, None
            self.post_message(self.Slid(parameter, min(max((event.x - begin) / (cells - 1), 0.0), 1.0)))

    @property
    def key_at_cursor(self) -> tuple[str, str, str] | None:
        """The key of the row at the cursor."""
        return self.key(self.current) if self.current else None

    def key(self, item: Row) -> tuple[str, str, str]:
        """The node, group or parameter of a row, regardless of its value."""
        return item.node, item.name, item.parameter.name if item.parameter else ""

    def exchange(self, rows: Sequence[Row], *, stay: bool = True) -> None:
        """Show these rows; if the columns have moved, redraw all of them."""
        before, self._measures = self._measures, measure(rows)
        super().exchange(rows, stay=stay)
        if self._measures != before:
            self.refresh()

    def matches(self, index: int, query: Query) -> bool:
        """Whether the row is a parameter that matches a filter; nodes and groups never do."""
        parameter = self.rows[index].parameter
        return parameter is not None and matches(parameter, query)

    def row(self, index: int, width: int) -> list[Segment]:
        """A node, a group or a parameter."""
        row = self.rows[index]
        if row.parameter is None:
            return self._head(row)
        return self._parameter(row, row.parameter, width)

    def _head(self, row: Row) -> list[Segment]:
        arrow, indent = "▸" if row.folded else "▾", "  " * row.depth
        if row.name:
            count = f"  {row.count}" if row.folded else ""
            return [Segment(f"{indent}{arrow} {sanitize(row.name)}{count}", self.row_style("dim"))]
        if row.ended:
            text = f"{indent}  {sanitize(row.title or row.node)}  {sanitize(row.problem)}"
            return [Segment(text, self.row_style("dim"))]
        head = Segment(f"{indent}{arrow} {sanitize(row.title or row.node)}", self.row_style("head"))
        if row.problem:
            return [head, Segment(f"  {sanitize(row.problem)}", self.row_style("warn"))]
        return [head, Segment(f"  {row.count}", self.row_style("dim"))]

    def _parameter(self, row: Row, parameter: ParameterInfo, width: int) -> list[Segment]:
        own = columns(self._measures, width, self.split)
        taken = name_column(row, own, width, self.split)
        over = taken - own.name
        name = cut("  " * row.depth + sanitize(row.name), taken, pad=True)
        key = (parameter.node, parameter.name)
        mark = "".join(sign if here else " " for sign, here in self.signs(parameter))
        segments = [
            Segment(f"{mark}{name}{' ' * GAP_CELLS}", self.row_style("strong" if parameter.changed else "plain"))
        ]
        left = max(0, width - MARKS_CELLS - taken - GAP_CELLS)
        value, dim = shown_value(row), self.row_style("dim")
        refused, late, staged = self._edits.refused.get(key), self._edits.late, self._edits.staging.marked
        if refused or key in late:
            waits = f"… {sanitize(value_text(late[key]))}: not answered yet" if key in late else ""
            note = waits or (beside_row(refused) if refused else "")
            cells = min(own.value, left)
            if left - cells - GAP_CELLS < len(note):  # the column may be wider than this value needs
                cells = min(cells, len(value))
            output = Segment(cut(note, max(0, left - cells - GAP_CELLS)), self.row_style("warn" if waits else "error"))
            return [*segments, Segment(cut(value, cells, pad=True) + " " * GAP_CELLS), output]
        if key in staged:
            unit = f" {parameter.unit}" if parameter.unit else ""
            text = f"{sanitize(value_text(parameter.value))} → {sanitize(value_text(staged[key]))}{unit}"
            return [*segments, Segment(cut(text, left), self.row_style("good"))]
        slider = slider_text(parameter, own.bar) if own.bar and not over else ""
        has_room = left >= max(own.value, len(value)) + GAP_CELLS + len(READ_ONLY)
        tail = slider or (READ_ONLY if parameter.read_only and has_room else "")
        segments.append(self._value(value, own.value, left, parameter, bool(tail)))
        used = segments[-1].cell_length
        if tail:
            segments.append(Segment(cut(" " * GAP_CELLS + tail, left - used), dim))
            used += segments[-1].cell_length
        start = own.value + GAP_CELLS + own.bar + GAP_CELLS - over
        if own.description and used <= start - GAP_CELLS:
            segments.append(Segment(" " * (start - used) + cut(sanitize(parameter.description), own.description), dim))
        return segments

    def signs(self, parameter: ParameterInfo) -> tuple[tuple[str, bool], ...]:
        """The two marks before a parameter, each with whether it is drawn."""
        key = (parameter.node, parameter.name)
        from_elsewhere = parameter.origin.startswith(SET_BY[ChangeSource.OTHER])
        first = ("•", True) if parameter.changed else ("◦", key in self._edits.moved)
        return (first, ("*", True) if key in self._edits.unsaved else ("~", from_elsewhere))

    def _value(self, value: str, column: int, left: int, parameter: ParameterInfo, more: bool) -> Segment:
        """A value in its column if more follows and it fits; otherwise in all the room that is left."""
        text = cut(value, column, pad=True) if more and len(value) <= column else cut(value, left)
        if (parameter.node, parameter.name) in self.flashing:
            return Segment(text, self.row_style("good") + Style(reverse=True))
        return Segment(text, self.row_style("dim") if parameter.read_only else None)

    def on_click(self, event: Click) -> None:
        """Select the clicked row; post `Pressed` if it was selected already. A press on a slider is no click."""
        event.prevent_default()  # the handler of other lists
        index = event.y + self.scroll_offset.y
        if self._slid or not 0 <= index < self.row_count():
            return
        chosen, row = index == self.cursor, self.rows[index]
        self.choose(index)
        if self._dragged:
            return
        if chosen or (row.parameter is None and event.x < 2 * row.depth + 2):
            self.post_message(self.Pressed(row))

    def _slider_at(self, x: int, index: int) -> tuple[ParameterInfo, int, int] | None:
        """The parameter whose slider is at a place, with the slider's first cell and its width; selects its row."""
        row = self.rows[index] if 0 <= index < self.row_count() else None
        if row is None or row.parameter is None or row.parameter.read_only:
            return None
        own = columns(self._measures, self.across, self.split)
        taken = name_column(row, own, self.across, self.split)
        begin = MARKS_CELLS + taken + GAP_CELLS + own.value + GAP_CELLS
        slides = own.bar > 1 and taken == own.name and bool(slider_text(row.parameter, own.bar))
        if not slides or not begin <= x < begin + own.bar:
            return None
        self.choose(index)
        return row.parameter, begin, own.bar


def slider_text(parameter: ParameterInfo, cells: int) -> str:
    """A slider of `cells` cells that shows where a number is in its range; empty without a finite range."""
    limits, value = parameter.range, parameter.value
    if limits is None or not limits.finite or isinstance(value, (bool, str, tuple)) or value is None:
        return ""
    place = round(limits.share(value) * (cells - 1))
    return "─" * place + "●" + "─" * (cells - 1 - place)
