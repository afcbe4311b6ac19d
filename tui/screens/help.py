"""Help for the focused pane, made from the key table."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import ClassVar

from bot_console.tui import keymap
from bot_console.tui.keymap import TABLE
from bot_console.tui.keys.key import Key, key_text
from bot_console.tui.screens.overlay import Overlay
from bot_console.tui.text.rendered_once import RenderedOnce
from rich.console import RenderableType
from rich.style import Style
from rich.table import Table
from rich.text import Text
from textual.binding import BindingType
from textual.events import Click

KEY = "pressed_key"
"""Under which name a line of the help carries its key."""


class HelpScreen(Overlay):
    """What a pane is for, and its keys, then those that work everywhere. A click on a line presses its key."""

    BINDINGS: ClassVar[list[BindingType]] = [*keymap.bindings("help")]

    def __init__(self, scopes: Sequence[str], title: str, text: str) -> None:
        super().__init__(title or "Help")
        self._scopes = scopes
        self._text = text

    def content(self) -> Iterable[RenderableType]:
        """The text, then two tables of keys."""
        if self._text:
            yield Text(self._text + "\n", "dim")
        own, *shared = (TABLE.get(each, ()) for each in self._scopes)
        if own:
            yield _keys(own)
        yield Text("\nEverywhere", "bold")
        yield _keys((*TABLE["app"], *(key for keys in shared for key in keys)))

    def on_click(self, event: Click) -> None:
        """A click on a line closes the help and does what its key does."""
        key = event.style.meta.get(KEY)
        if isinstance(key, str):
            self.dismiss()
            self.app.call_later(self.app.simulate_key, key)  # pyright: ignore[reportUnknownMemberType] -- Textual's App is generic, and its type is not told


def _keys(rows: tuple[Key, ...]) -> RenderedOnce:
    table = Table.grid(padding=(0, 2))
    table.add_column(style="bold", justify="right", min_width=12)
    table.add_column()
    for key in rows:
        pressed = Style(meta={KEY: key.keys.split(",")[0]})
        table.add_row(Text(key_text(key), pressed), Text(key.text, pressed))
    return RenderedOnce(table)
