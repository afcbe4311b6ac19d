"""A framed box of text over the panes that scrolls with the keys of the key table."""

from __future__ import annotations

from typing import ClassVar

from bot_console.tui import keymap
from textual.binding import BindingType
from textual.containers import VerticalScroll
from textual.widget import Widget


class WithScrollBox(Widget):
    """A screen around one box. The box never has the focus, which would bring its own keys."""

    BINDINGS: ClassVar[list[BindingType]] = [*keymap.bindings("box")]

    @property
    def _box(self) -> VerticalScroll:
        return self.query_one(VerticalScroll)

    def action_scroll_box(self, step: int) -> None:
        """Scroll by a line."""
        self._box.scroll_relative(y=step, animate=False)

    def action_page_box(self, step: int) -> None:
        """Scroll by a page."""
        self._box.scroll_relative(y=step * max(1, self._box.size.height - 1), animate=False)

    def action_end_of_box(self, end: int) -> None:
        """Scroll to the top or the bottom."""
        self._box.scroll_to(y=0 if end < 0 else self._box.max_scroll_y, animate=False)
