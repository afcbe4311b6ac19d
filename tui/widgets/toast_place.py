"""Places notifications above the status line, but never over the row at the cursor or a text field in use."""

from __future__ import annotations

from bot_console.tui.widgets.row_list import RowList
from textual.app import ScreenStackError
from textual.css.query import NoMatches
from textual.screen import Screen
from textual.widget import Widget
from textual.widgets import Input

BELOW_ROWS = 2
"""Lines kept free below notifications, for the status line and the key bar."""
MAX_LINES = 6
"""Maximum lines of a notification, as in the style sheet."""
LEFT_COLUMNS = 2
"""Columns to the left of notifications; the right end of a pane's bottom border stays visible."""
RACK = "#textual-toastrack"


def place_toasts(screen: Screen[object], *, another: bool = False) -> None:
    """Show only the newest notification of a screen, or none if `another` follows, without covering the line in use."""
    try:
        rack = screen.query_one(RACK)
    except (NoMatches, ScreenStackError):
        return
    # The style sheet does this when notifications are added, but not when the newest one is removed.
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
    """The lines to keep free below a notification on a screen of `height` lines, so that `line` stays visible.

    The last `foot` lines are never covered.
    """
    covered = line is not None and height - foot - MAX_LINES <= line < height - foot
    return height - line if line is not None and covered else foot


def line_in_use(focused: Widget | None) -> int | None:
    """The screen line of the focused list's cursor, or of the focused text field; None if neither has the focus."""
    if isinstance(focused, RowList) and focused.row_count():
        return focused.content_region.y + focused.cursor - focused.scroll_offset.y
    return focused.region.y if isinstance(focused, Input) else None
