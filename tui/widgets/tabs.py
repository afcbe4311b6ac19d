"""The first line: digits and titles of the panes."""

from __future__ import annotations

from collections.abc import Sequence

from rich.style import Style
from rich.text import Text


def tabs_text(marks: Sequence[tuple[str, str, str, bool]], width: int, colour: str) -> Text:
    """Digits and titles of the panes; short titles, then none but the shown one's, where there is little room."""
    for form in ("long", "short", "digits"):
        parts: list[Text] = []
        for digit, title, brief, shown in marks:
            word = title if form == "long" else (brief if form == "short" or shown else "")
            label = f"{digit} {word}".strip()
            padded = f"[{label}]" if shown else (label if form == "short" else f" {label} ")
            parts.append(Text(padded, Style(color=colour, bold=True, reverse=True) if shown else ""))
        text = Text(" ", no_wrap=True).join(parts)
        if text.cell_len <= width:
            return text
    return Text()
