"""What lies over the panes: a framed box that Escape closes, and from which the robot can be stopped."""

from __future__ import annotations

from collections.abc import Iterable
from typing import ClassVar

from rich.console import RenderableType
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import VerticalScroll
from textual.screen import ModalScreen
from textual.widgets import Static


class Overlay(ModalScreen[None]):
    """A title and what is to be read below it."""

    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("escape,enter,q", "dismiss", "Close"),
        Binding("exclamation_mark", "app.all_stop", "All stop", show=False),
        Binding("ctrl+q,ctrl+c", "app.quit", "Quit", show=False, priority=True),
        Binding("down,j", "scroll_box(1)", "Down", show=False),
        Binding("up,k", "scroll_box(-1)", "Up", show=False),
    ]
    DEFAULT_CSS = """
    Overlay { align: center middle; }
    Overlay VerticalScroll { width: 90%; max-width: 110; height: auto; max-height: 90%; background: $panel;
                             border: round $primary; padding: 0 1; scrollbar-size-vertical: 1; }
    """

    def __init__(self, title: str) -> None:
        super().__init__()
        self._title = title

    def content(self) -> Iterable[RenderableType]:
        """What stands in the box, from above."""
        raise NotImplementedError

    def compose(self) -> ComposeResult:
        """The box."""
        with VerticalScroll() as box:
            box.border_title = self._title.replace("[", r"\[")
            box.border_subtitle = "esc closes"
            for each in self.content():
                yield Static(each)

    def action_scroll_box(self, step: int) -> None:
        """Scroll by a line."""
        self.query_one(VerticalScroll).scroll_relative(y=step, animate=False)
