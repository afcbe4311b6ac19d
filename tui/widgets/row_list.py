"""A virtual list: rows are drawn when they are visible, so that a million cost what forty do."""

from __future__ import annotations

from typing import ClassVar

from bot_console.tui import keymap
from bot_console.tui.console.query import Query
from bot_console.tui.terminal.styling.style_sheet import StyledByPart
from rich.segment import Segment
from rich.style import Style
from textual.events import Click
from textual.geometry import Region, Size
from textual.message import Message
from textual.reactive import reactive
from textual.scroll_view import ScrollView
from textual.strip import Strip

LOUD = ("warn", "error", "good")
"""Styles whose colour says something."""
UNCUT = 1000
"""Cells in which a row that is searched has room for all it says."""


class RowList(ScrollView, StyledByPart, can_focus=True):  # pyright: ignore[reportIncompatibleMethodOverride] -- Textual's own
    """Rows with a cursor. A subclass gives `row_count` and `row(index, width)`."""

    BINDINGS = keymap.bindings("list")
    DEFAULT_CSS = """
    RowList { height: 1fr; background: $surface; overflow-x: hidden;
              scrollbar-size-vertical: 1; scrollbar-background: $surface; }
    RowList:focus { background: $surface; }
    """
    COMPONENT_CLASSES: ClassVar[set[str]] = {
        f"row-list--{each}" for each in ("cursor", "dim", "head", "warn", "error", "good", "strong", "plain")
    }

    cursor: reactive[int] = reactive(0, init=False)
    """The row that keys act on."""

    class Moved(Message):
        """The cursor stands on another row."""

        def __init__(self, rows: RowList, index: int) -> None:
            super().__init__()
            self.rows = rows
            self.index = index

        @property
        def control(self) -> RowList:
            """The list."""
            return self.rows

    def row_count(self) -> int:
        """How many rows there are."""
        raise NotImplementedError

    def row(self, index: int, width: int) -> list[Segment]:
        """The segments of a row; they are padded to the width (cells), or end there in an ellipsis."""
        raise NotImplementedError

    @property
    def across(self) -> int:
        """The cells that a row has: those beside the scroll bar."""
        return self.scrollable_content_region.width

    def rows_changed(self) -> None:
        """Rows came, went or moved: draw anew."""
        count = self.row_count()
        size = Size(self.size.width, count)
        if size != self.virtual_size:
            self._extend(size)
        if self.cursor >= count:
            self.cursor = max(0, count - 1)
        self.refresh()

    def _extend(self, size: Size) -> None:
        """Take the size of all rows; the screen is laid out anew only where the scroll bar comes or goes with it.

        Textual does that for each line of a log, which takes a tenth of the thread that draws.
        """
        stays = self.show_vertical_scrollbar and min(size.height, self.virtual_size.height) > self.size.height
        if not stays or size.width != self.virtual_size.width:
            self.virtual_size = size
            return
        self.set_reactive(RowList.virtual_size, size)  # pyright: ignore[reportArgumentType] -- a reactive of Textual, which tells no type of it
        self.vertical_scrollbar.window_virtual_size = size.height
        self.scroll_y = self.validate_scroll_y(self.scroll_y)

    def row_changed(self, index: int) -> None:
        """One row has other content: draw it alone."""
        y = index - self.scroll_offset.y
        if 0 <= y < self.size.height:
            self.refresh(Region(0, y, self.size.width, 1))

    def render_line(self, y: int) -> Strip:
        """One line of what is seen."""
        index = y + self.scroll_offset.y
        width = self.across
        base = self.own_style
        if index >= self.row_count():
            return Strip.blank(width, base)
        if index == self.cursor and self.has_focus:
            cursor = self.get_component_rich_style("row-list--cursor")
            strip = Strip(Segment(text, self._chosen(style, cursor)) for text, style, _ in self.row(index, width))
            return _fitted(strip, width, cursor)
        return _on(_fitted(Strip(self.row(index, width)), width, base), base)

    def _chosen(self, style: Style | None, cursor: Style) -> Style:
        """The cursor's style; what warns keeps its colour under it."""
        loud = (self.part_style(f"row-list--{each}").color for each in LOUD)
        return cursor + Style(color=style.color) if style and style.color and style.color in loud else cursor

    def watch_cursor(self, before: int, after: int) -> None:
        """Redraw the two rows, keep the cursor in view, and tell."""
        self.row_changed(before)
        self.row_changed(after)
        self.show_cursor()
        self.post_message(self.Moved(self, after))

    def show_cursor(self) -> None:
        """Scroll so that the cursor is seen."""
        top, height = self.scroll_offset.y, max(1, self.size.height)
        if self.cursor < top:
            self.scroll_to(y=self.cursor, animate=False, force=True)
        elif self.cursor >= top + height:
            self.scroll_to(y=self.cursor - height + 1, animate=False, force=True)

    def action_cursor(self, step: int) -> None:
        """Move the cursor by some rows."""
        self.cursor = min(max(0, self.cursor + step), max(0, self.row_count() - 1))

    def action_page(self, step: int) -> None:
        """Move the cursor by some pages."""
        self.action_cursor(step * max(1, self.size.height - 1))

    def action_end(self, end: int) -> None:
        """The first row, or the last; told also where the cursor stands there already."""
        before = self.cursor
        self.action_cursor(end * self.row_count())
        if self.cursor == before:
            self.post_message(self.Moved(self, before))

    def matches(self, index: int, query: Query) -> bool:
        """Whether a row matches a filter; here by what is drawn."""
        return query.matches("".join(each.text for each in self.row(index, UNCUT)))

    def find(self, query: Query, step: int) -> bool:
        """Move the cursor to the next match (`step` 1) or the previous (-1), around the end; whether there is any."""
        count = self.row_count()
        places = ((self.cursor + step * away) % count for away in range(1, count + 1))
        place = next((each for each in places if self.matches(each, query)), None)
        if place is not None:
            self.cursor = place
        return place is not None

    def on_click(self, event: Click) -> None:
        """A click moves the cursor, a second one at once does what Enter does."""
        y = event.y + self.scroll_offset.y
        if y >= self.row_count():
            return
        if y == self.cursor and event.chain == 2:
            self.app.simulate_key("enter")  # pyright: ignore[reportUnknownMemberType] -- Textual's App is generic, and its type is not told
        else:
            self.cursor = y

    def on_focus(self) -> None:
        """Show the cursor."""
        self.row_changed(self.cursor)

    def on_blur(self) -> None:
        """Hide the cursor."""
        self.row_changed(self.cursor)

    def on_resize(self) -> None:
        """Fit the rows to the new width."""
        self.rows_changed()
        self.show_cursor()


def _fitted(strip: Strip, width: int, style: Style) -> Strip:
    """A row of exactly so many cells; one that is longer ends in an ellipsis."""
    if strip.cell_length <= width or width < 1:
        return strip.adjust_cell_length(width, style)
    kept = strip.crop(0, width - 1)
    last = next((each.style for each in reversed(list(kept)) if each.text), None)
    return Strip([*kept.adjust_cell_length(width - 1, style), Segment("…", last)])


def _on(strip: Strip, base: Style) -> Strip:
    """Segments on the list's background where they have none of their own."""
    return Strip([Segment(text, base + style if style else base) for text, style, _ in strip], strip.cell_length)
