"""The content of the terminal, cell by cell, and the shortest output that turns it into a new content."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from bot_console.tui.terminal.cells import BLANK, NARROW, Cells, cells_of
from bot_console.tui.terminal.sgr import RESET, codes_for_blank, style_change
from rich.color import ColorSystem
from rich.segment import Segment
from textual.strip import Strip

UNKNOWN = "\0"
"""Marks a cell whose content on the terminal is unknown."""

JUMP_BYTES = 4
"""Bytes of a cursor move within a line: up to this many equal cells are rewritten instead."""


class ShownScreen:
    """The cells of the terminal as they were written last."""

    def __init__(self, plain: bool = False) -> None:
        """`plain` as in `cells_of`."""
        self._plain = plain
        self._characters: list[list[str]] = []
        self._styles: list[list[str]] = []
        self._strips: list[dict[int, list[Segment]]] = []

    def forget(self, width: int, height: int) -> None:
        """Forget what the terminal shows, because it was resized or others have written to it."""
        self._characters = [[UNKNOWN] * width for _ in range(height)]
        self._styles = [[""] * width for _ in range(height)]
        self._strips = [{} for _ in range(height)]

    @property
    def size(self) -> tuple[int, int]:
        """The size in columns and lines."""
        return len(self._characters[0]) if self._characters else 0, len(self._characters)

    def update(self, lines: Iterable[tuple[int, Mapping[int, Strip | None]]], colours: ColorSystem) -> str:
        """Apply new strips by line and column; returns the output that draws them, empty if they are drawn already."""
        writer = Writer()
        for y, pieces in lines:
            if 0 <= y < len(self._characters):
                for x, cells in self._changed(y, pieces, colours):
                    self._write(writer, y, x, cells)
        return writer.text()

    def _changed(self, y: int, pieces: Mapping[int, Strip | None], colours: ColorSystem) -> Iterator[tuple[int, Cells]]:
        """The strips of a line that differ from those drawn last."""
        known = self._strips[y]
        if known.keys() != pieces.keys():
            # Strips that begin in other columns overwrite parts of the old ones, which are no longer comparable.
            known = self._strips[y] = {x: [] for x in pieces}
        for x, strip in pieces.items():
            if strip is None:
                continue
            segments = list(strip)
            if segments != known[x]:
                known[x] = segments
                yield x, cells_of(segments, colours, self._plain)

    def _write(self, writer: Writer, y: int, x: int, new: Cells) -> None:
        characters, styles = self._characters[y], self._styles[y]
        end = min(len(characters), x + len(new.characters))
        differing = [
            at for at in range(x, end) if new.characters[at - x] != characters[at] or (new.styles[at - x] != styles[at])
        ]
        if not differing:
            return
        # Terminals disagree on the width of some characters, so everything after the first change there is rewritten.
        uncertain = x + min(_first_uneven(characters[x:end]), _first_uneven(new.characters))
        characters[x:end], styles[x:end] = new.characters[: end - x], new.styles[: end - x]
        begin = next((at for at in differing if at >= uncertain), end)
        if begin < end:
            # The second half of a wide character cannot be written without the first.
            while begin > x and not characters[begin]:
                begin -= 1
            differing = [*(at for at in differing if at < begin), *range(begin, end)]
        for at in differing:
            writer.cell(y, at, characters, styles)


def _first_uneven(characters: list[str]) -> int:
    """The index of the first cell on whose width terminals may disagree; the number of cells if there is none."""
    if NARROW.fullmatch("".join(characters).replace(UNKNOWN, BLANK)):
        return len(characters)
    certain = (each == UNKNOWN or (len(each) == 1 and NARROW.fullmatch(each)) for each in characters)
    return next((at for at, each in enumerate(certain) if not each), len(characters))


class Writer:
    """Collects cells into text with few cursor moves and style changes."""

    def __init__(self) -> None:
        self._parts: list[str] = []
        self._style: str | None = None
        self._y = -1
        self._x = -1

    def cell(self, y: int, x: int, characters: list[str], styles: list[str]) -> None:
        """Write one cell of a line; cells come in order."""
        self._move(y, x, characters, styles)
        style = self._style_of(characters[x], styles[x])
        if style != self._style:
            self._parts.append(style_change(self._style, style))
            self._style = style
        self._parts.append(characters[x])
        self._x = x + 1

    def _style_of(self, character: str, style: str) -> str:
        """The style in which to write a cell: for a blank, the one with the shortest change that looks the same."""
        return style if character != BLANK or self._style is None else codes_for_blank(self._style, style)

    def _move(self, y: int, x: int, characters: list[str], styles: list[str]) -> None:
        if y != self._y:
            self._parts.append(f"\x1b[{y + 1};{x + 1}H" if x else f"\x1b[{y + 1}H")
        elif x > self._x:
            self._parts.append(self._across(characters[self._x : x], styles[self._x : x]))
        self._y = y

    def _across(self, characters: list[str], styles: list[str]) -> str:
        """Skip unchanged cells by rewriting them or by a cursor move, whichever is shorter."""
        text = "".join(characters)
        known = UNKNOWN not in characters and "" not in characters
        same = (self._style_of(*each) == self._style for each in zip(characters, styles, strict=True))
        if known and len(text.encode()) <= JUMP_BYTES and all(same):
            return text
        return f"\x1b[{len(characters)}C"

    def text(self) -> str:
        """The collected text, with the style reset at its end."""
        return "".join([*self._parts, RESET]) if self._parts else ""
