"""The last line: the keys of the focused pane, then those that work everywhere; from the key table."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from types import MappingProxyType
from typing import TypeAlias

from bot_console.tui.keymap import TABLE
from bot_console.tui.keys.key import Key, key_text
from rich.cells import cell_len
from rich.style import Style
from rich.text import Text
from textual.events import Click
from textual.widgets import Static

GAP = "  "
NO_OTHERS: Mapping[str, str] = MappingProxyType({})
FILTER = "slash"
"""The key of the pane that gives way last."""

Shown: TypeAlias = "tuple[str, str, str]"
"""How a key is written, what it does, and its name for Textual."""


class KeyBar(Static):
    """Shows keys and what they do, dropping those of the pane first if room is short. A click presses the key."""

    DEFAULT_CSS = "KeyBar { height: 1; padding: 0 1; background: $panel; color: $text; text-wrap: nowrap; }"

    def __init__(self) -> None:
        super().__init__("", markup=False)
        self._shown: object = None
        self._keys: list[Shown] = []
        self._asked: tuple[Sequence[str], bool, str, int, Mapping[str, str]] | None = None

    def show(
        self, scopes: Sequence[str], typing: bool, colour: str, columns: int, words: Mapping[str, str] = NO_OTHERS
    ) -> None:
        """Show the keys of some scopes of the key table; while typing, those of a text field.

        `columns` is the width of the bar if it has not been laid out yet; `words` replace those of the table, by the
        ids of the keys, and a key whose word is empty is omitted.
        """
        self._asked = (scopes, typing, colour, columns, words)
        width = (self.size.width or columns) - 2
        now = (scopes, typing, colour, width, words)
        if now == self._shown or width < 1:
            return
        self._shown = now
        if typing:
            own, everywhere = [("enter", "take it", "enter"), ("esc", "give up", "escape")], []
        else:
            own = [key for scope in scopes for key in _named(TABLE.get(scope, ()), words)]
            everywhere = list(_named(TABLE["app"], words))
        while own and _line([*own, *everywhere], colour).cell_len > width:
            own.pop(next((at for at in reversed(range(len(own))) if own[at][2] != FILTER), 0))
        while everywhere and _line([*own, *everywhere], colour).cell_len > width:
            everywhere.pop(1 if len(everywhere) > 1 else 0)
        self._keys = [*own, *everywhere]
        self.update(_line(self._keys, colour), layout=False)

    def on_resize(self) -> None:
        """Fit the keys to the new width."""
        if self._asked is not None:
            self.show(*self._asked)

    def on_click(self, event: Click) -> None:
        """Press the key under the mouse."""
        end = 0
        for key in self._keys:
            begin, end = end, end + cell_len(f"{key[0]} {key[1]}") + len(GAP)
            if begin <= event.x - 1 < end:
                self.app.simulate_key(key[2])  # pyright: ignore[reportUnknownMemberType] -- Textual's App is generic, and its type is not told


def _named(keys: Iterable[Key], words: Mapping[str, str]) -> Iterable[Shown]:
    for key in keys:
        word = words.get(key.id, key.short or key.text)
        if key.footer and word:
            yield key.shown or key_text(key, 1), word, key.keys.split(",")[0]


def _line(keys: Iterable[Shown], colour: str) -> Text:
    text = Text(no_wrap=True)
    for shown, word, _ in keys:
        text.append(GAP if text else "")
        text.append(shown, Style(color=colour, bold=True))
        text.append(f" {word}")
    return text
