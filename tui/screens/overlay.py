"""What lies over the panes: a framed box that Escape closes, and from which the robot can be stopped."""

from __future__ import annotations

from collections.abc import Iterable
from typing import ClassVar

from bot_console.tui import keymap
from bot_console.tui.format import harmless
from rich.console import RenderableType
from rich.text import Text
from textual.app import ComposeResult
from textual.binding import BindingType
from textual.containers import VerticalScroll
from textual.screen import ModalScreen
from textual.widgets import Static


class Overlay(ModalScreen[None]):
    """A title and what is to be read below it."""

    BINDINGS: ClassVar[list[BindingType]] = [*keymap.bindings("overlay")]
    DEFAULT_CSS = """
    Overlay { align: center middle; }
    Overlay VerticalScroll { width: 90%; max-width: 110; height: auto; max-height: 90%; background: $panel;
                             border: round $primary; padding: 0 1; scrollbar-size-vertical: 1; }
    """

    def __init__(self, title: str) -> None:
        super().__init__()
        self._heading = title

    def content(self) -> Iterable[RenderableType]:
        """What stands in the box, from above."""
        raise NotImplementedError

    def compose(self) -> ComposeResult:
        """The box."""
        with VerticalScroll() as box:
            box.border_title = Text(harmless(self._heading))
            box.border_subtitle = "esc closes"
            for each in self.content():
                yield Static(each)

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
        """To the top, or to the bottom."""
        self._box.scroll_to(y=0 if end < 0 else self._box.max_scroll_y, animate=False)
