"""The screen with all facts about one item: lines under headings."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from bot_console.tui.screens.overlay import Overlay
from bot_console.tui.text.sanitize import sanitize
from rich.console import RenderableType
from rich.text import Text

Section = tuple[str, Sequence[str]]
"""A heading and its lines."""


class FactsScreen(Overlay):
    """Shows sections one below the other, leaving out empty ones."""

    def __init__(self, title: str, sections: Sequence[Section]) -> None:
        super().__init__(title)
        self._sections = sections

    def content(self) -> Iterable[RenderableType]:
        """The sections."""
        text = Text()
        for heading, lines in self._sections:
            if lines:
                text.append(("\n" if text else "") + heading + "\n", "bold")
                for line in lines:
                    text.append(f"  {sanitize(line)}\n")
        text.rstrip()
        yield text
