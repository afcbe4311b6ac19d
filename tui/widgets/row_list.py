"""A virtual list: only visible rows are drawn, so that a million rows cost no more than forty."""

from __future__ import annotations

from typing import ClassVar

from bot_console.tui import keymap
from bot_console.tui.console.filter_syntax import Query
from bot_console.tui.terminal.styling import StyledByPart
from bot_console.tui.widgets.placeholder import WithPlaceholder, placeholder_lines
from rich.segment import Segment
from rich.style import Style
from textual.events import Click
from textual.geometry import Region, Size
from textual.message import Message
from textual.reactive import reactive
from textual.scroll_view import ScrollView
from textual.strip import Strip

LOUD = ("warn", "error", "good")
"""Styles whose colour has a meaning."""
UNCUT_CELLS = 1000
"""Width (cells) with which a row is drawn for a search, so that nothing is cut off."""


class RowList(ScrollView, StyledByPart, WithPlaceholder, can_focus=True):  # pyright: ignore[reportIncompatibleMethodOverride] -- Textual's own
    """Rows with a cursor. Subclasses define `row_count` and `row(index, width)`."""

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
        """The cursor has moved to another row: by the user (`by_person`), or because rows have come or gone."""

        def __init__(self, rows: RowList, index: int, *, by_person: bool) -> None:
            super().__init__()
            self.rows = rows
            self.index = index
            self.by_person = by_person

        @property
        def control(self) -> RowList:
            """The list."""
            return self.rows

    class Resized(Message):
        """The size of the list has changed, and with it the widths of its columns and the visible rows."""

    _by_person = False
    """Whether the user is moving the cursor."""

    def row_count(self) -> int:
        """The number of rows."""
        raise NotImplementedError

    def row(self, index: int, width: int) -> list[Segment]:
        """The segments of a row; the list pads them to the width (cells) or truncates them with an ellipsis."""
        raise NotImplementedError

    def row_style(self, name: str) -> Style:
        """A style of segments by its name, such as `dim`; see `COMPONENT_CLASSES`."""
        return self.part_style(f"row-list--{name}")

    @property
    def across(self) -> int:
        """The width of a row in cells, without the scroll bar."""
        return self.scrollable_content_region.width

    def rows_changed(self) -> None:
        """Redraw after rows were added, removed or moved."""
        count = self.row_count()
        size = Size(self.size.width, count)
        if size != self.virtual_size:
            self._extend(size)
        if self.cursor >= count:
            self.cursor = max(0, count - 1)
        self.refresh()

    def _extend(self, size: Size) -> None:
        """Set the virtual size; lay out the screen only if the scroll bar appears or disappears.

        Textual would lay it out for each new line of a log, which takes a tenth of the drawing thread's time.
        """
        stays = self.show_vertical_scrollbar and min(size.height, self.virtual_size.height) > self.size.height
        if not stays or size.width != self.virtual_size.width:
            self.virtual_size = size
            return
        self.set_reactive(RowList.virtual_size, size)  # pyright: ignore[reportArgumentType] -- a reactive of Textual, which tells no type of it
        self.vertical_scrollbar.window_virtual_size = size.height
        self.scroll_y = self.validate_scroll_y(self.scroll_y)

    def row_changed(self, index: int) -> None:
        """Redraw a single row whose content has changed."""
        y = index - self.scroll_offset.y
        if 0 <= y < self.size.height:
            self.refresh(Region(0, y, self.size.width, 1))

    def render_line(self, y: int) -> Strip:
        """Render one visible line."""
        index = y + self.scroll_offset.y
        width = self.across
        base = self.own_style
        if index >= self.row_count():
            return self._below_rows(y, width, base)
        if index == self.cursor and self.has_focus:
            cursor = self.get_component_rich_style("row-list--cursor")
            strip = Strip(Segment(text, self._chosen(style, cursor)) for text, style, _ in self.row(index, width))
            return _fit(strip, width, cursor)
        return _with_background(_fit(Strip(self.row(index, width)), width, base), base)

    def _below_rows(self, y: int, width: int, base: Style) -> Strip:
        """A line without a row: blank, or part of the placeholder if there are no rows at all."""
        lines = placeholder_lines(self.placeholder, width, self.size.height) if not self.row_count() else ()
        if y >= len(lines):
            return Strip.blank(width, base)
        styles = {"": base, "dim": self.row_style("dim"), "key": self.row_style("head")}
        segments = [Segment(text, base + styles[name]) for text, name in lines[y]]
        return Strip(segments).adjust_cell_length(width, base)

    def _chosen(self, style: Style | None, cursor: Style) -> Style:
        """The cursor's style for a segment; warnings keep their colour."""
        loud = (self.row_style(each).color for each in LOUD)
        return cursor + Style(color=style.color) if style and style.color and style.color in loud else cursor

    def watch_cursor(self, before: int, after: int) -> None:
        """Redraw both rows, scroll to the cursor, and post `Moved`."""
        self.row_changed(before)
        self.row_changed(after)
        self.show_cursor()
        self.post_message(self.Moved(self, after, by_person=self._by_person))

    def choose(self, index: int) -> None:
        """Move the cursor on behalf of the user: by key, mouse or search."""
        self._by_person = True
        try:
            self.cursor = index
        finally:
            self._by_person = False

    def show_cursor(self) -> None:
        """Scroll the cursor into view."""
        top, height = self.scroll_offset.y, max(1, self.size.height)
        if self.cursor < top:
            self.scroll_to(y=self.cursor, animate=False, force=True)
        elif self.cursor >= top + height:
            self.scroll_to(y=self.cursor - height + 1, animate=False, force=True)

    def action_cursor(self, step: int) -> None:
        """Move the cursor by a number of rows."""
        self.choose(min(max(0, self.cursor + step), max(0, self.row_count() - 1)))

    def action_page(self, step: int) -> None:
        """Move the cursor by a number of pages."""
        self.action_cursor(step * max(1, self.size.height - 1))

    def action_end(self, end: int) -> None:
        """Move to the first or last row; posts `Moved` even if the cursor is there already."""
        before = self.cursor
        self.action_cursor(end * self.row_count())
        if self.cursor == before:
            self.post_message(self.Moved(self, before, by_person=True))

    def matches(self, index: int, query: Query) -> bool:
        """Whether a row matches a filter; by default, its drawn text decides."""
        return query.matches("".join(each.text for each in self.row(index, UNCUT_CELLS)))

    def find(self, query: Query, step: int) -> bool:
        """Move to the next (`step` 1) or previous (-1) match, wrapping around; returns whether one exists."""
        count = self.row_count()
        places = ((self.cursor + step * away) % count for away in range(1, count + 1))
        place = next((each for each in places if self.matches(each, query)), None)
        if place is not None:
            self.choose(place)
        return place is not None

    def on_click(self, event: Click) -> None:
        """Move the cursor; a double click does what Enter does."""
        y = event.y + self.scroll_offset.y
        if y >= self.row_count():
            return
        if y == self.cursor and event.chain == 2:
            self.app.simulate_key("enter")  # pyright: ignore[reportUnknownMemberType] -- Textual's App is generic
        else:
            self.choose(y)

    def on_focus(self) -> None:
        """Show the cursor."""
        self.row_changed(self.cursor)

    def on_blur(self) -> None:
        """Hide the cursor."""
        self.row_changed(self.cursor)

    def on_resize(self) -> None:
        """Fit the rows to the new width, and post `Resized`."""
        self.rows_changed()
        self.show_cursor()
        self.post_message(self.Resized())


def _fit(strip: Strip, width: int, style: Style) -> Strip:
    """A row padded or truncated to a width (cells); a truncated row ends with an ellipsis."""
    if strip.cell_length <= width or width < 1:
        return strip.adjust_cell_length(width, style)
    kept = strip.crop(0, width - 1)
    last = next((each.style for each in reversed(list(kept)) if each.text), None)
    return Strip([*kept.adjust_cell_length(width - 1, style), Segment("…", last)])


def _with_background(strip: Strip, base: Style) -> Strip:
    """Draw segments that have no background on the background of the list."""
    return Strip([Segment(text, base + style if style else base) for text, style, _ in strip], strip.cell_length)
