"""A piece of a line as single cells: the character and the style of each. Pure."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable
from functools import lru_cache
from typing import NamedTuple

from bot_console.tui.terminal.ascii import plain_text
from bot_console.tui.terminal.sgr import codes_on_blank
from rich.cells import get_character_cell_size
from rich.color import ColorSystem
from rich.segment import Segment
from rich.style import Style
from textual.strip import Strip

NARROW = re.compile(
    r"[\x20-\x7e\xa0-\xac\xae-\u02ff\u2190-\u21a8\u21ab-\u21ff\u2500-\u25fc\u2713\u2717\u2718\u2800-\u28ff]*"
)
"""Matches texts whose characters all take one cell in every terminal; it excludes arrows that are also emoji."""

ACTING_CATEGORIES = frozenset(("Cc", "Cf", "Cs"))
"""Categories of characters that terminals obey or that cannot be encoded: controls, formatting, surrogates."""
UNSHOWN = "?"
BLANK = " "


class Cells(NamedTuple):
    """Characters and SGR codes, one of each per cell."""

    characters: list[str]
    styles: list[str]


def cells_of(segments: Iterable[Segment], colours: ColorSystem, plain: bool = False) -> Cells:
    """The cells of a segment of a line. A wide character occupies its first cell; the second one is empty.

    Characters that act on a terminal are left out. `plain` is for terminals that show only ASCII: drawing characters
    are replaced by similar ones. The codes of a blank are only those that it shows.
    """
    characters: list[str] = []
    styles: list[str] = []
    for given, style, control in segments:
        if control:
            continue
        before = len(characters)
        text = plain_text(given) if plain else given
        if NARROW.fullmatch(text):
            characters += text
        else:
            _append_cells(text, characters)
        codes = codes_of(style, colours) if style else ""
        on_blank = codes_on_blank(codes)
        styles += [on_blank if each == BLANK else codes for each in characters[before:]]
    return Cells(characters, styles)


def _append_cells(text: str, characters: list[str]) -> None:
    for character in text:
        width = get_character_cell_size(character)
        if unicodedata.category(character) in ACTING_CATEGORIES:
            # A character that acts on a terminal never reaches it, whoever drew it; one with a width leaves a
            # `UNSHOWN`.
            characters += [UNSHOWN] * max(0, width)
            continue
        if width:
            characters.append(character)
            characters += [""] * (width - 1)
        elif characters:
            # A zero-width character joins the one before it, which is two cells back if that is wide.
            characters[-1 if characters[-1] or len(characters) == 1 else -2] += character


@lru_cache(maxsize=4096)
def codes_of(style: Style, colours: ColorSystem) -> str:
    """The SGR codes of a style."""
    return Strip.render_ansi(style, colours)
