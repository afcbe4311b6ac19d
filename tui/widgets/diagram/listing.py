"""A list in place of a drawing: one entry per item, which continues on further rows if it is long. Pure."""

from __future__ import annotations

from dataclasses import dataclass

from bot_console.tui.widgets.diagram.drawing import Drawing, Place, Run
from rich.cells import cell_len

INDENT_CELLS = 4
MIN_ROW_CELLS = 20
"""Minimum cells of a row; in a narrower window, the list is cut at the edge."""


@dataclass(frozen=True)
class Listing:
    """Items with their texts, from top to bottom."""

    entries: tuple[tuple[str, str], ...] = ()


def draw_listing(listing: Listing, width: int) -> Drawing:
    """Draw the entries in rows of at most `width` cells, wrapped at blanks."""
    rows: list[tuple[Run, ...]] = []
    places: dict[str, Place] = {}
    for item, text in listing.entries:
        lines = wrapped(text, max(width, MIN_ROW_CELLS))
        widest = max(map(cell_len, lines))
        places[item] = Place(0, len(rows), widest, len(lines), False)
        rows += [(Run(0, line, item),) for line in lines]
    return Drawing(rows, places, max((place.width for place in places.values()), default=0))


def wrapped(text: str, width: int) -> list[str]:
    """A text in lines of at most `width` cells; those after the first are indented."""
    lines: list[str] = []
    line = ""
    for word in text.split(" "):
        longer = f"{line} {word}" if line.strip() else line + word
        if line.strip() and cell_len(longer) > width:
            lines.append(line)
            longer = " " * INDENT_CELLS + word
        line = longer
    return [*lines, line]
