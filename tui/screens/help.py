"""Help for the focused pane, made from the key table."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from typing import ClassVar

from bot_console.tui import keymap
from bot_console.tui.keymap import TABLE
from bot_console.tui.screens.key_table import KEY, KeyTable
from bot_console.tui.screens.overlay import Overlay
from rich.console import RenderableType
from rich.text import Text
from textual.binding import BindingType
from textual.events import Click
from textual.widget import Widget

LINE_END = re.compile(r"(?<=\S)\n(?=\S)")
"""The end of a line within a paragraph. Paragraphs are wrapped to the screen, indented lines of a list are not."""


class HelpScreen(Overlay):
    """Shows the purpose of a pane and its keys, then the global ones. A click on a line presses its key."""

    BINDINGS: ClassVar[list[BindingType]] = [*keymap.bindings("help")]

    def __init__(self, scopes: Sequence[str], title: str, text: str, *, alone: bool = False) -> None:
        """Create the screen; with `alone` it omits the global keys, for a mode in which these do not work."""
        super().__init__(title or "Help")
        self._alone = alone
        self._scopes = scopes
        self._text = text

    def content(self) -> Iterable[RenderableType | Widget]:
        """The text, then two tables of keys."""
        if self._text:
            yield Text(LINE_END.sub(" ", self._text) + "\n", "dim")
        own, *shared = (TABLE.get(each, ()) for each in self._scopes)
        if own:
            yield KeyTable(own)
        if self._alone:
            return
        yield Text("\nEverywhere", "bold")
        yield KeyTable((*TABLE["app"], *(key for keys in shared for key in keys)))

    def on_click(self, event: Click) -> None:
        """Close the help and press the key of the line that was clicked."""
        key = event.style.meta.get(KEY)
        if isinstance(key, str):
            self.dismiss()
            self.app.call_later(self.app.simulate_key, key)  # pyright: ignore[reportUnknownMemberType] -- Textual's App is generic
