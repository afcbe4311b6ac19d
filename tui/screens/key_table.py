"""A table of keys and what they do; only visible lines are rendered.

Rich lays out a whole table before its first line can be shown, which was a third of the time to open the help.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from bot_console.tui.keys.key import Key, key_text
from bot_console.tui.terminal.styling import StyledByPart
from rich.cells import cell_len
from rich.segment import Segment
from rich.style import Style
from textual.geometry import Size
from textual.strip import Strip

KEY = "pressed_key"
"""The key of a line's metadata that holds the key to press."""
GAP_CELLS = 2
MIN_KEY_CELLS = 12
"""Cells between a key and its description, and minimum cells of the key column."""

BOLD = Style(bold=True)


class Line(NamedTuple):
    """A line: the texts of its two columns, and the key that a click on it presses."""

    key: str
    text: str
    pressed: str


class KeyTable(StyledByPart):
    """Two columns: keys and their descriptions, wrapped as needed."""

    DEFAULT_CSS = """
    KeyTable { height: auto; }
    """

    def __init__(self, keys: Sequence[Key]) -> None:
        super().__init__()
        self._rows = [(key_text(key), key.text, key.keys.split(",")[0]) for key in keys]
        self._column = max([MIN_KEY_CELLS, *(cell_len(key) for key, _, _ in self._rows)])
        self._width = -1
        self._lines: list[Line] = []

    def get_content_height(self, container: Size, viewport: Size, width: int) -> int:
        """The number of lines at a width."""
        return len(self._at(width))

    def render_line(self, y: int) -> Strip:
        """Render a line, blank after the last one."""
        width, style = self.size.width, self.own_style
        lines = self._at(width)
        if y >= len(lines):
            return Strip.blank(width, style)
        line = lines[y]
        style += Style(meta={KEY: line.pressed})
        segments = [
            Segment(" " * (self._column - cell_len(line.key)), style),
            Segment(line.key, style + BOLD),
            Segment(" " * GAP_CELLS + line.text, style),
        ]
        return Strip(segments).adjust_cell_length(width, style)

    def _at(self, width: int) -> Sequence[Line]:
        if width != self._width:
            self._width = width
            self._lines = [
                Line(key if number == 0 else "", part, pressed)
                for key, text, pressed in self._rows
                for number, part in enumerate(wrapped(text, max(1, width - self._column - GAP_CELLS)))
            ]
        return self._lines


def wrapped(text: str, width: int) -> Sequence[str]:
    """Wrap a text to a width in cells between words; a longer word is on its own line."""
    lines = [""]
    for word in text.split(" "):
        longer = f"{lines[-1]} {word}" if lines[-1] else word
        if lines[-1] and cell_len(longer) > width:
            lines.append(word)
        else:
            lines[-1] = longer
    return lines
