"""The base of panes with a list: the filter, moving between matches, and the number of rows shown."""

from __future__ import annotations

from typing import ClassVar

from bot_console.tui.console.filter_syntax import Query, parse
from bot_console.tui.keys.key import NO_MODE, Mode
from bot_console.tui.panes.pane import Pane
from bot_console.tui.widgets.prompt.filtered import Filterable
from bot_console.tui.widgets.prompt.line import Prompt
from bot_console.tui.widgets.prompt.question import Line
from bot_console.tui.widgets.row_list import RowList

FILTERED = Mode(
    {"narrowed.all": "Clear filter", "find.next": "Next"},
    "A filter is on: Escape clears it; n and N go to the next and the previous match.",
)


class ListPane(Pane, Filterable):
    """A pane whose first `RowList` has a filter. Subclasses define `_arrange` and compose a `Prompt`."""

    SCOPES: ClassVar[tuple[str, ...]] = ("find", "narrowed", "list")

    _query = Query()
    """The parsed filter."""

    @property
    def mode(self) -> Mode:
        """While a filter narrows the list, the mode with the keys that clear it and move between matches."""
        return FILTERED if self.words else NO_MODE

    def set_filter(self, words: str) -> None:
        """Set the filter, and show its keys."""
        super().set_filter(words)
        self.keys_changed()

    def apply_filter(self, words: str) -> None:
        """Show the rows that pass the filter."""
        self._query = parse(words)
        self._arrange()

    def _arrange(self) -> None:
        """Show the rows that pass `_query`."""
        raise NotImplementedError

    def ask_words(self, line: Line) -> None:
        """Ask for search words at the bottom of the pane."""
        self.query_one(Prompt).ask(line)

    def _searched(self) -> RowList:
        return self.query(RowList).first()

    def find(self, words: str, step: int) -> bool:
        """Go to the next matching row; returns whether there is one."""
        return self._searched().find(parse(words), step)

    def is_on_match(self, words: str) -> bool:
        """Whether the row at the cursor matches."""
        rows = self._searched()
        return rows.cursor < rows.row_count() and rows.matches(rows.cursor, parse(words))

    def report_filter(self, shown: int, every: int, *more: str) -> None:
        """Show the filter, `more` texts on what narrows the list, and the number of matches in the bottom border."""
        narrowed = (f"/{self.words}" if self.words else "", *more)
        counts = f"{shown} of {every}" if any(narrowed) else ""
        self.caption("  ".join(each for each in (*narrowed, counts) if each))
