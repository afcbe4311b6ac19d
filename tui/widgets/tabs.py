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
    """The id of the pane."""
    shown: bool


class Tabs(Static):
    """Shows keys and titles of the panes; a click on one shows the pane."""

    class Chosen(Message):
        """A tab was clicked."""

        def __init__(self, pane: str) -> None:
            super().__init__()
            self.pane = pane

    def __init__(self) -> None:
        super().__init__("", markup=False)
        self._ends: list[tuple[int, str]] = []

    def show(self, tabs: Sequence[Tab], width: int, colour: str) -> None:
        """Show the tabs, shortened as far as the width requires."""
        parts = tab_texts(tabs, width, colour)
        end = 0
        self._ends = []
        for part, tab in zip(parts, tabs, strict=False):  # there are no parts if there is no room at all
            end += part.cell_len
            self._ends.append((end, tab.pane))
        self.update(Text.assemble(*parts, no_wrap=True), layout=False)

    def on_click(self, event: Click) -> None:
        """Choose the tab under the mouse."""
        for end, pane in self._ends:
            if event.x < end:
                self.post_message(self.Chosen(pane))
                return


LENGTHS = 4
"""Number of lengths of a title: with spaces around it, short, three characters, and none."""


def tab_texts(tabs: Sequence[Tab], width: int, colour: str) -> list[Text]:
    """The keys and titles of the panes, as parts that follow each other without a gap.

    If there is little room, titles are shortened, starting with the last one; the shown pane's title comes last.
    """
    order = sorted(reversed(range(len(tabs))), key=lambda at: tabs[at].shown)
    lengths = [0] * len(tabs)
    for shortened, length in ((order, 0), (order, 1), *(([at], each) for each in range(2, LENGTHS) for at in order)):
        for at in shortened:
            lengths[at] = length
        parts = _parts(tabs, lengths, colour)
        if tabs[-1].shown and sum(part.cell_len for part in parts) > width:
            parts[0] = parts[0][1:]  # frees a cell for the bracket after the last one
        if sum(part.cell_len for part in parts) <= width:
            return parts
    return []


def _parts(tabs: Sequence[Tab], lengths: Sequence[int], colour: str) -> list[Text]:
    """The tabs as texts; the brackets of the shown one replace the gaps beside it."""
    parts: list[Text] = []
    for at, (tab, length) in enumerate(zip(tabs, lengths, strict=True)):
        label = _label(tab, length)
        if tab.shown:
            parts.append(Text(f"[{label}]", Style(color=colour, bold=True, reverse=True)))
        else:
            follows = at > 0 and tabs[at - 1].shown
            parts.append(Text(label if follows else f" {label}"))
        if length == 0:
            parts[-1].append("  ")
    return parts


def _label(tab: Tab, length: int) -> str:
    word = (tab.title, tab.short, tab.short[:3], "")[length]
    # In front of a title this short, the key is omitted if it is the title's first character.
    merged = length == LENGTHS - 2 and word.startswith(tab.key)
    return sanitize(word if merged else f"{tab.key} {word}".strip())
