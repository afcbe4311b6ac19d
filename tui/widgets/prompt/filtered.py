"""Widgets with a filter: one way to ask for it, to clear it, and to go from match to match."""

from __future__ import annotations

from typing import ClassVar

from bot_console.tui import keymap
from bot_console.tui.widgets.prompt.common import filter_line
from bot_console.tui.widgets.prompt.question import Line
from textual.binding import BindingType
from textual.widget import Widget


class Findable(Widget):
    """Words are looked for in it: `/` asks for them, n and N go on to the next and the previous match."""

    BINDINGS: ClassVar[list[BindingType]] = keymap.bindings("find")

    words = ""
    """The filter, as it was typed; empty when there is none."""

    _sought = ""
    """The last words looked for, which outlive the filter."""

    def ask_words(self, line: Line) -> None:
        """Ask for the words."""
        raise NotImplementedError

    def filter_is(self, words: str) -> None:
        """Take a filter that parses into account; empty: there is none any more."""
        raise NotImplementedError

    def find(self, words: str, step: int) -> bool:
        """Go `step` matches on, the last one being followed by the first; whether there is any."""
        raise NotImplementedError

    def stands_on_match(self, words: str) -> bool:
        """Whether the cursor stands on a match already."""
        raise NotImplementedError

    def set_filter(self, words: str) -> None:
        """Filter by these words from now on."""
        self.words = words
        self._sought = words or self._sought
        self.filter_is(words)

    def _taken(self, words: str) -> None:
        self.set_filter(words)
        if words and not self.stands_on_match(words):
            self.find(words, 1)

    def action_filter(self) -> None:
        """Ask for a filter, which acts while it is typed; the cursor then stands on a match."""
        self.ask_words(filter_line(self.words, self.set_filter, self._taken))

    def action_find(self, step: int) -> None:
        """The next match, or the previous one."""
        if not self._sought:
            self.notify("Nothing was looked for yet; / asks for words.")
        elif not self.find(self._sought, step):
            self.notify(f"Nothing here matches {self._sought}", severity="warning", markup=False)


class Narrowed(Findable):
    """What is shown is what passes the filter; Escape shows everything again."""

    BINDINGS: ClassVar[list[BindingType]] = keymap.bindings("narrowed")

    def action_clear_filter(self) -> None:
        """Show everything again."""
        self.set_filter("")
