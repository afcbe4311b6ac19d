"""ASCII replacements for the console's characters, for terminals and locales that have only ASCII. Pure."""

from __future__ import annotations

from functools import lru_cache

from rich.cells import cell_len

SIMILAR_CHARACTERS = {
    **dict.fromkeys("─━═╌╍┄┅┈┉╴╶╸╺", "-"),
    **dict.fromkeys("│┃║╎╏┆┇┊┋╵╷╹╻▏▕▌▐", "|"),
    **dict.fromkeys("→⇒▸▶▷►", ">"),
    **dict.fromkeys("←⇐◂◀◁◄", "<"),
    **dict.fromkeys("↑⇑▴▲△⇧", "^"),
    **dict.fromkeys("↓⇓▾▼▽", "v"),
    **dict.fromkeys("█▓▉▊▋■◼▪", "#"),
    **dict.fromkeys("▒░▂▃▄▅▆▇▀", "="),
    **dict.fromkeys("•·∙⋅", "."),
    **dict.fromkeys("●◉◆★✔✓", "*"),
    **dict.fromkeys("○◦◌◇☆□◻", "o"),
    **dict.fromkeys("✗✘✖×", "x"),
    **dict.fromkeys("“”„", '"'),
    **dict.fromkeys("‘’‚", "'"),
    **dict.fromkeys("–—−", "-"),
    "✚": "+",
    "▰": "#",
    "▱": "-",
    "◐": "o",
    **dict.fromkeys("↺↻", "@"),
    "⏎": ";",
    "▁": "_",
    "…": "~",
    "°": "o",
    "±": "~",
    "²": "2",
    "³": "3",
    "⚠": "!",
    "≤": "<",
    "≥": ">",
    "≠": "!",
    "≈": "~",
    "µ": "u",
    "μ": "u",
    "↔": "-",
    "↕": "|",
    "↗": "/",
    "↙": "/",
    "↶": "<",
    "↷": ">",
    "↖": "\\",
    "↘": "\\",
    "\xa0": " ",
}
DOTS = " .::::*###"
"""The replacements for braille characters, by the number of dots."""


@lru_cache(maxsize=65536)
def plain_character(character: str) -> str:
    """A similar ASCII character, or several if it takes several cells; `?` if there is none."""
    if character.isascii():
        return character
    code = ord(character)
    if 0x2800 <= code <= 0x28FF:
        return DOTS[(code - 0x2800).bit_count()]
    if character in SIMILAR_CHARACTERS:
        return SIMILAR_CHARACTERS[character]
    if 0x2500 <= code <= 0x257F:
        return "+"
    return "?" * cell_len(character)


def plain_text(text: str) -> str:
    """Convert a text to ASCII of the same width in cells."""
    return text if text.isascii() else "".join(map(plain_character, text))
