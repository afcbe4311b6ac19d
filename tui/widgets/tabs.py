"""The first line: digits and titles of the panes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

from bot_console.tui.text.shown import harmless
from rich.style import Style
from rich.text import Text
from textual.events import Click
from textual.message import Message
from textual.widgets import Static

Mark: TypeAlias = "tuple[str, str, str, str, bool]"
"""A pane's digit, title, short title and id, and whether it is shown."""


class Tabs(Static):
    """Digits and titles; a click shows the pane."""

    class Chosen(Message):
        """A tab was clicked."""

        def __init__(self, pane: str) -> None:
            super().__init__()
            self.pane = pane

    def __init__(self) -> None:
        super().__init__("", markup=False)
        self._ends: list[tuple[int, str]] = []

    def show(self, marks: Sequence[Mark], width: int, colour: str) -> None:
        """Show the tabs as wide as there is room."""
        parts = tab_texts(marks, width, colour)
        end = 0
        self._ends = []
        for part, mark in zip(parts, marks, strict=False):  # none if there is no room at all
            end += part.cell_len + 1
            self._ends.append((end, mark[3]))
        self.update(Text(" ", no_wrap=True).join(parts), layout=False)

    def on_click(self, event: Click) -> None:
        """Choose the tab under the mouse."""
        for end, pane in self._ends:
            if event.x - 1 < end:
                self.post_message(self.Chosen(pane))
                return


def tab_texts(marks: Sequence[Mark], width: int, colour: str) -> list[Text]:
    """Digits and titles of the panes; if room is short, with short titles, and the last ones without any first."""
    for titled, long in ((len(marks), True), *((most, False) for most in range(len(marks), -1, -1))):
        parts: list[Text] = []
        for at, (digit, title, brief, _, shown) in enumerate(marks):
            word = title if long else (brief if at < titled or shown else "")
            label = harmless(f"{digit} {word}".strip())
            padded = f"[{label}]" if shown else (label if not long else f" {label} ")
            parts.append(Text(padded, Style(color=colour, bold=True, reverse=True) if shown else ""))
        if sum(part.cell_len + 1 for part in parts) - 1 <= width:
            return parts
    return []
