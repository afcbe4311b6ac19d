"""The base of widgets with a filter: asking for it, clearing it, and moving between matches."""

from __future__ import annotations

from typing import ClassVar

from bot_console.tui import keymap
from bot_console.tui.widgets.prompt.common import filter_line
from bot_console.tui.widgets.prompt.question import Line
from textual.binding import BindingType
from textual.widget import Widget


class Searchable(Widget):
    """A widget that can be searched: `/` asks for words, n and N go to the next and the previous match."""

    BINDINGS: ClassVar[list[BindingType]] = keymap.bindings("find")

    words = ""
    """The filter as typed; empty if there is none."""

    _sought = ""
    """The last search words, which are kept when the filter is cleared."""

    def ask_words(self, line: Line) -> None:
        """Ask for the words."""
        raise NotImplementedError

    def apply_filter(self, words: str) -> None:
        """Apply a valid filter; an empty one removes it."""
        raise NotImplementedError

    def find(self, words: str, step: int) -> bool:
        """Go `step` matches further, wrapping around; returns whether there is any match."""
        raise NotImplementedError

    def is_on_match(self, words: str) -> bool:
        """Whether the cursor is already on a match."""
        raise NotImplementedError

    def set_filter(self, words: str) -> None:
        """Set the filter."""
        self.words = words
        self._sought = words or self._sought
        self.apply_filter(words)

    def _taken(self, words: str) -> None:
        self.set_filter(words)
        if words and not self.is_on_match(words):
            self.find(words, 1)

    def action_filter(self) -> None:
        """Ask for a filter, applied while it is typed; afterwards the cursor is on a match."""
        self.ask_words(filter_line(self.words, self.set_filter, self._taken))

    def action_find(self, step: int) -> None:
        """Go to the next or the previous match."""
        if not self._sought:
            self.notify("There is no search yet; / starts one.")
        elif not self.find(self._sought, step):
            self.notify(f"Nothing here matches {self._sought}", severity="warning", markup=False)


class Filterable(Searchable):
    """A widget that shows only what passes the filter; Escape shows everything again."""

    BINDINGS: ClassVar[list[BindingType]] = keymap.bindings("narrowed")

    def action_clear_filter(self) -> None:
        """Show everything again."""
        self.set_filter("")
