"""Places notifications above the status line, but never over the row or the text field that has the keyboard."""

from __future__ import annotations

from bot_console.tui.widgets.row_list import RowList
from textual.app import ScreenStackError
from textual.css.query import NoMatches
from textual.screen import Screen
from textual.widget import Widget
from textual.widgets import Input

BELOW_ROWS = 2
"""Lines of the status line and the key bar, below notifications on a screen without panes."""
MAX_LINES = 6
"""Maximum lines of a notification, as in the style sheet."""
LEFT_COLUMNS = 2
"""Columns to the left of notifications; the right end of a pane's lower edge is left visible."""
RACK = "#textual-toastrack"


def place_toasts(screen: Screen[object], *, another: bool = False) -> None:
    """Show the newest notification of a screen, or none if `another` follows; the row at the cursor stays visible."""
    try:
        rack = screen.query_one(RACK)
    except (NoMatches, ScreenStackError):
        return
    # The style sheet does so for new notifications, but not for the one before a notification that is removed.
    for each in rack.children:
        each.display = not another and each is rack.children[-1]
    below = lines_below(line_in_use(screen.focused), screen.size.height, _foot(screen))
    if rack.styles.margin.bottom != below:
        rack.styles.margin = (0, 0, below, LEFT_COLUMNS)


def _foot(screen: Screen[object]) -> int:
    """The lines below the panes, such as the status line and a bag's player."""
    try:
        panes = screen.query_one("#panes").region
    except NoMatches:
        return BELOW_ROWS
    return max(BELOW_ROWS, screen.size.height - panes.bottom) if panes.height else BELOW_ROWS


def lines_below(line: int | None, height: int, foot: int = BELOW_ROWS) -> int:
    """The lines to leave free below a notification on a screen of a `height`, if a `line` must stay visible.

    The last `foot` lines are never covered.
    """
    covered = line is not None and height - foot - MAX_LINES <= line < height - foot
    return height - line if line is not None and covered else foot


def line_in_use(focused: Widget | None) -> int | None:
    """The line on the screen of the row at the cursor, or of a text field; None if neither has the keyboard."""
    if isinstance(focused, RowList) and focused.row_count():
        return focused.content_region.y + focused.cursor - focused.scroll_offset.y
    return focused.region.y if isinstance(focused, Input) else None
