"""The base of screens over the panes: a framed box that Escape closes, and from which the robot can be stopped."""

from __future__ import annotations

from collections.abc import Iterable
from typing import ClassVar

from bot_console.tui import keymap
from bot_console.tui.screens.box import WithScrollBox
from bot_console.tui.terminal.dimmed_screen import DimmedScreen
from bot_console.tui.text.sanitize import sanitize
from rich.console import RenderableType
from rich.text import Text
from textual.app import ComposeResult
from textual.binding import BindingType
from textual.containers import VerticalScroll
from textual.events import Click
from textual.widget import Widget
from textual.widgets import Static


class Overlay(DimmedScreen, WithScrollBox):  # pyright: ignore[reportIncompatibleMethodOverride] # of Textual
    """A box with a title and text to read."""

    BINDINGS: ClassVar[list[BindingType]] = [*keymap.bindings("overlay")]
    DEFAULT_CSS = """
    Overlay { align: center middle; }
    Overlay VerticalScroll { width: 90%; max-width: 110; height: auto; max-height: 90%; background: $panel;
                             border: round $primary; padding: 0 1; scrollbar-size-vertical: 1; }
    """

    def __init__(self, title: str) -> None:
        super().__init__()
        self._heading = title

    def content(self) -> Iterable[RenderableType | Widget]:
        """The content of the box, from top to bottom."""
        raise NotImplementedError

    def on_click(self, event: Click) -> None:
        """Close on a click outside the box or on its lower edge."""
        box = self.query_one(VerticalScroll).region
        if not box.contains(event.screen_x, event.screen_y) or event.screen_y == box.bottom - 1:
            self.dismiss()

    def compose(self) -> ComposeResult:
        """The box."""
        with VerticalScroll(can_focus=False) as box:
            box.border_title = Text(sanitize(self._heading))
            box.border_subtitle = "Esc Close"
            for each in self.content():
                yield each if isinstance(each, Widget) else Static(each)
