"""The rows of the parameter pane as they are drawn: name, value, slider, description; or why a value was refused."""

from __future__ import annotations

from collections.abc import Sequence

from bot_console.tui.console.model import ParameterInfo, SetOutcome
from bot_console.tui.format import cut, harmless, value_text
from bot_console.tui.panes.parameters.columns import BAR, GAP, Measures, columns, measured, shown_value
from bot_console.tui.panes.parameters.rows import Row
from bot_console.tui.widgets.row_list import RowList
from rich.segment import Segment
from rich.style import Style


class ParameterRows(RowList):
    """The rows of the tree."""

    def __init__(self) -> None:
        super().__init__()
        self.rows: Sequence[Row] = []
        self.refused: dict[tuple[str, str], SetOutcome] = {}
        """The refusals that are still marked, by node and parameter."""

        self._measures = Measures()

    def row_count(self) -> int:
        """How many rows there are."""
        return len(self.rows)

    @property
    def current(self) -> Row | None:
        """The row at the cursor."""
        return self.rows[self.cursor] if self.rows and self.cursor < len(self.rows) else None

    def take(self, rows: Sequence[Row]) -> bool:
        """Show other rows from now on; tells whether the columns have moved, so that all must be drawn."""
        before, self.rows = self._measures, rows
        self._measures = measured(rows)
        return self._measures != before

    def row(self, index: int, width: int) -> list[Segment]:
        """A node, a group or a parameter."""
        row = self.rows[index]
        if row.parameter is None:
            return self._head(row)
        return self._parameter(row, row.parameter, width)

    def _style(self, name: str) -> Style:
        return self.get_component_rich_style(f"row-list--{name}", partial=True)

    def _head(self, row: Row) -> list[Segment]:
        if row.name:
            return [Segment(f"{'  ' * row.depth}{harmless(row.name)}.", self._style("dim"))]
        arrow = "▸" if row.folded else "▾"
        head = Segment(f"{arrow} {harmless(row.node)}", self._style("head"))
        if row.problem:
            return [head, Segment(f"  {harmless(row.problem)}", self._style("warn"))]
        return [head, Segment(f"  {row.count}", self._style("dim"))]

    def _parameter(self, row: Row, parameter: ParameterInfo, width: int) -> list[Segment]:
        own = columns(self._measures, width)
        name = cut("  " * row.depth + harmless(row.name), own.name, pad=True)
        mark = "•" if parameter.changed else " "
        segments = [Segment(f"{mark}{name}{' ' * GAP}", self._style("strong" if parameter.changed else "plain"))]
        left = max(0, width - 1 - own.name - GAP)
        value, dim = shown_value(row), self._style("dim")
        refused = self.refused.get((parameter.node, parameter.name))
        if refused:
            value = cut(value, min(own.value, left), pad=True)
            why = f"✗ {harmless(value_text(refused.value))}: {harmless(refused.reason)}"
            room = max(0, left - own.value - GAP)
            return [*segments, Segment(value + " " * GAP), Segment(cut(why, room), self._style("error"))]
        slider = bar(parameter) if own.bar else ""
        tail = slider or ("read only" if parameter.read_only else "")
        segments.append(self._value(value, own.value, left, parameter.read_only, bool(tail)))
        used = segments[-1].cell_length
        if tail:
            segments.append(Segment(cut(" " * GAP + tail, left - used), dim))
            used += segments[-1].cell_length
        start = own.value + GAP + BAR + GAP
        if own.description and used <= start - GAP:
            segments.append(Segment(" " * (start - used) + cut(harmless(parameter.description), own.description), dim))
        return segments

    def _value(self, value: str, column: int, left: int, read_only: bool, more: bool) -> Segment:
        """A value in its column if something stands beside it and it fits, else in all the room there is."""
        text = cut(value, column, pad=True) if more and len(value) <= column else cut(value, left)
        return Segment(text, self._style("dim") if read_only else None)


def bar(parameter: ParameterInfo) -> str:
    """Where a number stands in its range."""
    limits, value = parameter.range, parameter.value
    if limits is None or isinstance(value, (bool, str, tuple)) or value is None or limits.high <= limits.low:
        return ""
    share = min(1.0, max(0.0, (value - limits.low) / (limits.high - limits.low)))
    place = round(share * (BAR - 1))
    return "─" * place + "●" + "─" * (BAR - 1 - place)
