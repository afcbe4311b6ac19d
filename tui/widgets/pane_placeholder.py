"""The frame of a pane that is still being made."""

from __future__ import annotations

from textual.containers import Container


class PanePlaceholder(Container):
    """Takes a pane's place in the first frame: its border and title, and nothing that takes keys."""

    def __init__(self, stands_for: str, title: str, *, chosen: bool) -> None:
        """`stands_for` is the id of the pane, `chosen` says whether that one gets the focus."""
        super().__init__(classes="chosen" if chosen else "")
        self.stands_for = stands_for
        self.border_title = title
