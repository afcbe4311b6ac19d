"""Lines of styled text, redrawn only where they have changed."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import lru_cache
from itertools import groupby
from typing import ClassVar, TypeAlias

from bot_console.tui.terminal.styling import StyledByPart
from bot_console.tui.widgets.placeholder import WithPlaceholder, placeholder_lines
from rich.cells import cell_len
from rich.segment import Segment
from rich.style import Style
from textual.geometry import Region
from textual.message import Message
from textual.strip import Strip

Piece: TypeAlias = "tuple[str, str]"
"""Text and the name of its style: one of `Picture.STYLES`, or empty for the plain style.

If the colours are data, as in a drawing, the name specifies them: `#b3b8ff on #4556ff`.
"""

Line: TypeAlias = "tuple[Piece, ...]"

MAX_REDRAWN_CELLS = 10
"""Unchanged cells up to this number are redrawn, as skipping them with a cursor move would cost about as much."""


def merged_line(pieces: Iterable[Piece]) -> Line:
    """A line of pieces, with adjacent pieces of the same style merged."""
    return tuple(("".join(text for text, _ in run), style) for style, run in groupby(pieces, lambda each: each[1]))


class Picture(StyledByPart, WithPlaceholder):
    """Shows styled lines; `Picture.STYLES` are the style names that their pieces may use."""

    STYLES: ClassVar[tuple[str, ...]] = (
        "dim", "strong", "good", "warn", "error", "accent", "key", "robot",
        "curve-0", "curve-1", "curve-2", "curve-3", "curve-4", "curve-5",
    )  # fmt: skip
    DEFAULT_CSS = """
    Picture { height: 1fr; background: $surface; color: $text; }
    .picture--dim { color: $secondary; }
    .picture--strong { text-style: bold; }
    .picture--good { color: $success; }
    .picture--warn { color: $warning; }
    .picture--error { color: $error; }
    .picture--accent { color: $primary; }
    .picture--key { color: $primary; text-style: bold; }
    .picture--robot { color: $background; background: $success; text-style: bold; }
    .picture--curve-0 { color: $curve-0; }
    .picture--curve-1 { color: $curve-1; }
    .picture--curve-2 { color: $curve-2; }
    .picture--curve-3 { color: $curve-3; }
    .picture--curve-4 { color: $curve-4; }
    .picture--curve-5 { color: $curve-5; }
    """
    COMPONENT_CLASSES: ClassVar[set[str]] = {f"picture--{each}" for each in STYLES}

    class Resized(Message):
        """The size to draw for has changed."""

    def __init__(self, *, id: str | None = None) -> None:
        super().__init__(id=id)
        self.lines: Sequence[Line] = ()

    def set_lines(self, lines: Sequence[Line]) -> None:
        """Show these lines, redrawing only the cells that have changed."""
        old, self.lines = self.lines, lines
        if len(old) != len(lines):
            self.refresh()
            return
        changed = [
            Region(start, y, end - start, 1)
            for y, (before, after) in enumerate(zip(old, lines, strict=True))
            if before != after
            for start, end in changed_intervals(before, after, self.size.width)
        ]
        if changed:
            self.refresh(*changed)

    def render_line(self, y: int) -> Strip:
        """Render one line."""
        base = self.own_style
        lines = self.lines or placeholder_lines(self.placeholder, *self.size)
        pieces = lines[y] if y < len(lines) else ()
        segments = [Segment(text, base + self._style(name) if name else base) for text, name in pieces]
        return Strip(segments).adjust_cell_length(self.size.width, base)

    def _style(self, name: str) -> Style:
        return _colors(name) if "#" in name else self.part_style(f"picture--{name}")

    def on_resize(self) -> None:
        """Post `Resized`, so that the lines are made for the new size."""
        self.post_message(self.Resized())


@lru_cache(maxsize=1024)
def _colors(name: str) -> Style:
    return Style.parse(name)


def changed_intervals(before: Line, after: Line, width: int) -> list[tuple[int, int]]:
    """The cells in which two lines differ, as intervals; nearby intervals are merged."""
    old, new = _cells(before, width), _cells(after, width)
    if old is None or new is None:
        return [(0, width)]
    found: list[tuple[int, int]] = []
    for at, (a, b) in enumerate(zip(old, new, strict=True)):
        if a != b:
            if found and at - found[-1][1] < MAX_REDRAWN_CELLS:
                found[-1] = (found[-1][0], at + 1)
            else:
                found.append((at, at + 1))
    return found


def _cells(line: Line, width: int) -> list[Piece] | None:
    """Character and style of each cell; None if any character is not exactly one cell wide."""
    if any(cell_len(text) != len(text) for text, _ in line):
        return None
    cells = [(character, style) for text, style in line for character in text][:width]
    return cells + [(" ", "")] * (width - len(cells))
