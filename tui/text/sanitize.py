"""Makes text safe and short enough for the screen. Pure."""

from __future__ import annotations

import unicodedata

from bot_console.tui.text.counted import counted
from rich.cells import cell_len, set_cell_size

WIDE_MARK = "\ufe0f"
"""Requests the coloured form of a symbol; terminals disagree on whether that is one cell wide or two."""
MAX_LINES, MAX_CHARACTERS = 6, 400
"""Maximum lines and characters of a notification; the log and the panes show the whole text."""


def sanitize(text: str) -> str:
    """A text with control characters and bidirectional marks made visible, so that none takes effect on the screen."""
    text = text.replace(WIDE_MARK, "")
    if text.isprintable():
        return text
    return "".join(each if each.isprintable() or each == " " else _visible(each) for each in text)


def _visible(character: str) -> str:
    code = ord(character)
    if character == "\t":
        return "    "
    if character == "\n":
        return "⏎ "
    if code < 32:
        return chr(0x2400 + code)
    return "␡" if code == 127 else ("" if unicodedata.category(character) == "Cf" else "�")


def cut(text: str, width: int, *, pad: bool = False) -> str:
    """A text of at most `width` cells; a longer one ends in an ellipsis. `pad` fills it up with blanks."""
    if cell_len(text) > width:
        text = set_cell_size(text, width - 1).rstrip() + "…" if width > 0 else ""
    return text + " " * (width - cell_len(text)) if pad else text


def cut_name(name: str, width: int, *, pad: bool = False) -> str:
    """A ROS name of at most `width` cells; the middle of a longer one is cut out, since both ends are distinctive."""
    if cell_len(name) > width >= 3:
        before = (width - 1) // 3
        end = len(name)
        while cell_len(name[end - 1 :]) <= width - 1 - before:
            end -= 1
        name = set_cell_size(name, before) + "…" + name[end:]
    return cut(name, width, pad=pad)


def brief(text: str) -> str:
    """A text for a notification: its first lines, sanitized, and the number of further ones."""
    lines = [sanitize(line) for line in cut(text, MAX_CHARACTERS).splitlines()]
    more = len(text.splitlines()) - MAX_LINES
    return "\n".join(lines if more <= 0 else [*lines[: MAX_LINES - 1], f"... and {counted(more + 1, 'line')} more"])
