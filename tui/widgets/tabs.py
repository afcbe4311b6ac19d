"""The first line: keys and titles of the panes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from bot_console.tui.text.sanitize import sanitize
from rich.style import Style
from rich.text import Text
from textual.events import Click
from textual.message import Message
from textual.widgets import Static


class Tab(NamedTuple):
    """A pane in the line of tabs."""

    key: str
    title: str
    short: str
    pane: str
    """Its id."""
    shown: bool


class Tabs(Static):
    """Keys and titles; a click shows the pane."""

    class Chosen(Message):
        """A tab was clicked."""

        def __init__(self, pane: str) -> None:
            super().__init__()
            self.pane = pane

    def __init__(self) -> None:
        super().__init__("", markup=False)
        self._ends: list[tuple[int, str]] = []

    def show(self, tabs: Sequence[Tab], width: int, colour: str) -> None:
        """Show the tabs as wide as there is room."""
        parts = tab_texts(tabs, width, colour)
        end = 0
        self._ends = []
        for part, tab in zip(parts, tabs, strict=False):  # none if there is no room at all
            end += part.cell_len + 1
            self._ends.append((end, tab.pane))
        self.update(Text(" ", no_wrap=True).join(parts), layout=False)

    def on_click(self, event: Click) -> None:
        """Choose the tab under the mouse."""
        for end, pane in self._ends:
            if event.x - 1 < end:
                self.post_message(self.Chosen(pane))
                return


def tab_texts(tabs: Sequence[Tab], width: int, colour: str) -> list[Text]:
    """Keys and titles of the panes; if room is short, with short titles, and the last ones without any first."""
    for titled, long in ((len(tabs), True), *((maximum, False) for maximum in range(len(tabs), -1, -1))):
        parts: list[Text] = []
        for at, tab in enumerate(tabs):
            word = tab.title if long else (tab.short if at < titled or tab.shown else "")
            label = sanitize(f"{tab.key} {word}".strip())
            padded = f"[{label}]" if tab.shown else (label if not long else f" {label} ")
            parts.append(Text(padded, Style(color=colour, bold=True, reverse=True) if tab.shown else ""))
        if sum(part.cell_len + 1 for part in parts) - 1 <= width:
            return parts
    return []
