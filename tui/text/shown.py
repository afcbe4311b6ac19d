"""Makes text safe and short enough for the screen. Pure."""

from __future__ import annotations

import unicodedata

from rich.cells import cell_len, set_cell_size

WIDE_MARK = "\ufe0f"
"""Asks for a symbol in colour; terminals disagree whether that makes it one cell wide or two."""
MOST_LINES, MOST_LETTERS = 6, 400
"""What a notification says at most; the log and the panes have the rest."""


def counted(number: int, word: str) -> str:
    """A number and a word, in the plural where it belongs."""
    return f"{number} {word}{'' if number == 1 else 's'}"


def harmless(text: str) -> str:
    """A text with control characters and bidirectional marks made visible, so that none takes effect on the screen."""
    text = text.replace(WIDE_MARK, "")
    if text.isprintable():
        return text
    return "".join(each if each.isprintable() or each == " " else _visible(each) for each in text)


def _visible(letter: str) -> str:
    code = ord(letter)
    if letter == "\t":
        return "    "
    if letter == "\n":
        return "⏎ "
    if code < 32:
        return chr(0x2400 + code)
    return "␡" if code == 127 else ("" if unicodedata.category(letter) == "Cf" else "�")


def cut(text: str, width: int, *, pad: bool = False) -> str:
    """A text of at most so many cells; a longer one ends in an ellipsis. `pad` fills it up with blanks."""
    if cell_len(text) > width:
        text = set_cell_size(text, width - 1).rstrip() + "…" if width > 0 else ""
    return text + " " * (width - cell_len(text)) if pad else text


def cut_name(name: str, width: int, *, pad: bool = False) -> str:
    """A ROS name of at most so many cells; a longer one loses its middle, since both ends tell it from others."""
    if cell_len(name) > width >= 3:
        before = (width - 1) // 3
        end = len(name)
        while cell_len(name[end - 1 :]) <= width - 1 - before:
            end -= 1
        name = set_cell_size(name, before) + "…" + name[end:]
    return cut(name, width, pad=pad)


def brief(text: str) -> str:
    """A text for a notification: its first lines, harmless, and how many more there are."""
    lines = [harmless(line) for line in cut(text, MOST_LETTERS).splitlines()]
    more = len(text.splitlines()) - MOST_LINES
    return "\n".join(lines if more <= 0 else [*lines[: MOST_LINES - 1], f"... and {counted(more + 1, 'line')} more"])
