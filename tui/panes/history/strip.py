"""The changes of the history on a timeline. Pure."""

from __future__ import annotations

from collections.abc import Sequence

from bot_console.tui.format import clock_text
from bot_console.tui.panes.history.sets import HistoryRow, changes_of
from bot_console.tui.text.refusals import verdict_of_change
from bot_console.tui.widgets.picture import Line, Piece, merged_line

MIN_CELLS = 12
"""Minimum cells of the timeline; if there is less room, it is not drawn."""
CHANGED, REFUSED, CHOSEN = "▲", "✗", "◆"


def time_strip(rows: Sequence[HistoryRow], chosen: HistoryRow | None, width: int) -> Line:
    """Draw a timeline from the first to the last change of one run, with a mark for each row.

    The run is that of the chosen row, or of the newest one.
    """
    if not rows:
        return ()
    run = changes_of(chosen or rows[0])[0].run
    shown = [each for each in rows if changes_of(each)[0].run == run]
    first, last = min(each.stamp for each in shown), max(each.stamp for each in shown)
    begin, end = (f" {clock_text(each)[:8]} " for each in (first, last))
    cells = width - len(begin) - len(end)
    if cells < MIN_CELLS or first == last:
        return ()
    marks: list[Piece] = [("─", "dim")] * cells
    for each in shown:
        at = (each.stamp - first) * (cells - 1) // (last - first)
        if any(verdict_of_change(change) for change in changes_of(each)):
            marks[at] = (REFUSED, "error")
        elif marks[at][0] != REFUSED:
            marks[at] = (CHANGED, "accent")
    if chosen is not None:
        at = (chosen.stamp - first) * (cells - 1) // (last - first)
        marks[at] = (CHOSEN, "error" if marks[at][0] == REFUSED else "strong")
    return ((begin, "dim"), *merged_line(marks), (end, "dim"))
