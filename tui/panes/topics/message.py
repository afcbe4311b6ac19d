"""The newest message of a topic as a tree that can be frozen and folded."""

from __future__ import annotations

from collections.abc import Sequence

from bot_console.tui.console.topics.port import Field, LiveMessage
from bot_console.tui.text.sanitize import cut, sanitize
from bot_console.tui.widgets.row_list import RowList
from rich.cells import cell_len
from rich.segment import Segment


def visible_fields(fields: Sequence[Field], closed: frozenset[str], opened: frozenset[str]) -> list[Field]:
    """The visible lines, without those below a folded one."""
    found: list[Field] = []
    skip = 0
    for field in fields:
        if skip:
            skip -= 1
            continue
        found.append(field)
        if is_folded(field, closed, opened):
            skip = field.holds
    return found


def is_folded(field: Field, closed: frozenset[str], opened: frozenset[str]) -> bool:
    """Whether a line is folded."""
    return field.holds > 0 and (field.path in closed or (field.closed and field.path not in opened))


class MessageRows(RowList):
    """The lines of a message."""

    def __init__(self) -> None:
        super().__init__()
        self.fields: Sequence[Field] = ()
        self.lines: list[Field] = []
        self._shut: frozenset[str] = frozenset()
        self._open: frozenset[str] = frozenset()
        self._widths = (0, 0)

    @property
    def current(self) -> Field | None:
        """The line at the cursor."""
        return self.lines[self.cursor] if self.cursor < len(self.lines) else None

    def show_message(self, message: LiveMessage) -> None:
        """Show the lines of a message; only changed ones are redrawn."""
        self.show_fields(message.fields)

    def show_fields(self, fields: Sequence[Field]) -> None:
        """Show these lines; only changed ones are redrawn."""
        if fields is self.fields:
            return
        self.fields = fields
        before, self.lines = self.lines, visible_fields(fields, self._shut, self._open)
        names = max((2 * each.depth + cell_len(sanitize(each.name)) + 2 for each in self.lines), default=0)
        widths = (names, len(self.lines))
        if widths != self._widths:
            self._widths = widths
            self.rows_changed()
            return
        for index, (old, new) in enumerate(zip(before, self.lines, strict=True)):
            if old != new:
                self.row_changed(index)

    def fold(self, closed: bool | None = None) -> bool:
        """Fold or unfold the line at the cursor, or with None toggle it; returns whether there is anything to fold."""
        line = self.current
        if line is None or not line.holds:
            return False
        closed = not is_folded(line, self._shut, self._open) if closed is None else closed
        self._shut = self._shut | {line.path} if closed else self._shut - {line.path}
        self._open = self._open - {line.path} if closed else self._open | {line.path}
        self.lines = visible_fields(self.fields, self._shut, self._open)
        self._widths = (0, 0)
        self.show_fields(list(self.fields))
        return True

    def row_count(self) -> int:
        """The number of lines."""
        return len(self.lines)

    def row(self, index: int, width: int) -> list[Segment]:
        """Name, value with its unit, type."""
        line = self.lines[index]
        names = min(self._widths[0] + 2, max(8, width // 2))
        arrow = "  " if not line.holds else "▸ " if is_folded(line, self._shut, self._open) else "▾ "
        name = cut(f"{'  ' * line.depth}{arrow}{sanitize(line.name)}", names, pad=True)
        unit = line.unit if line.text else ""
        value = cut(f"{sanitize(line.text)}{' ' if unit else ''}{unit}", max(0, width - names))
        segments = [Segment(name, self.row_style("dim") if line.depth and line.holds else None), Segment(value)]
        room = width - names - cell_len(value) - 2
        if line.type and room >= cell_len(line.type):
            segments.append(
                Segment("  " + " " * (room - cell_len(line.type)) + sanitize(line.type), self.row_style("dim"))
            )
        return segments
