"""A list of items that come, go and change; the cursor follows its item, and only changed rows are redrawn."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Generic, TypeVar

from bot_console.tui.widgets.row_list import RowList

T = TypeVar("T")


class ItemList(RowList, Generic[T]):
    """A list with one item per row. Subclasses define `row`, and `key` if a changed item remains the same item."""

    def __init__(self, rows: Sequence[T] = ()) -> None:
        super().__init__()
        self.rows: Sequence[T] = rows

    def key(self, item: T) -> object:
        """The identity of an item across changes."""
        return item

    def row_count(self) -> int:
        """The number of items."""
        return len(self.rows)

    @property
    def current(self) -> T | None:
        """The item at the cursor."""
        return self.rows[self.cursor] if self.cursor < len(self.rows) else None

    def exchange(self, rows: Sequence[T], *, stay: bool = True) -> None:
        """Show these items. With `stay`, the cursor silently follows its item, or stays near its position."""
        before, at, place = self.rows, self.current, self.cursor
        self.rows = rows
        if at is not None and stay:
            self.set_reactive(RowList.cursor, self._place(at))
        if len(before) != len(rows):
            self.rows_changed()
            self.show_cursor()
            return
        for index, (old, new) in enumerate(zip(before, rows, strict=True)):
            if old is not new and old != new:
                self.row_changed(index)
        if self.cursor != place:
            self.row_changed(place)
            self.row_changed(self.cursor)
            self.show_cursor()

    def begin_at(self, index: int) -> None:
        """Put the cursor on a row silently, as if it had been there from the start."""
        before = self.cursor
        if index != before:
            self.set_reactive(RowList.cursor, index)
            self.row_changed(before)
            self.row_changed(index)
            if self.size.height:  # else the first layout shows it
                self.show_cursor()

    def _place(self, item: T) -> int:
        wanted, last = self.key(item), max(0, len(self.rows) - 1)
        if self.cursor <= last and self.rows and self.key(self.rows[self.cursor]) == wanted:
            return self.cursor
        places = (index for index, each in enumerate(self.rows) if self.key(each) == wanted)
        return next(places, min(self.cursor, last))
