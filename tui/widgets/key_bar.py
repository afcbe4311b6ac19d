"""The last line of the screen: the keys of a mode, of the focused pane, and those that work everywhere."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import NamedTuple

from bot_console.tui.keymap import TABLE
from bot_console.tui.keys.key import NO_MODE, Key, Mode, key_text
from rich.cells import cell_len
from rich.style import Style
from rich.text import Text
from textual.events import Click
from textual.widgets import Static

GAP = "  "
NO_OTHERS: Mapping[str, str] = MappingProxyType({})
FILTER = "slash"
"""The last of the pane's keys to be left out."""
FIRST_DROPPED = ("app.line", "app.quit")
"""Global keys that a short bar leaves out before those of the pane, since the help names them."""
STOP = "app.stop"


class BarKey(NamedTuple):
    """A key as it is shown in the bar."""

    written: str
    word: str
    """The word for its action."""
    key: str
    """Textual's name of the key."""
    id: str


class KeyBar(Static):
    """Shows as many keys with their actions as fit. A click presses the key."""

    DEFAULT_CSS = "KeyBar { height: 1; padding: 0 1; background: $panel; color: $text; text-wrap: nowrap; }"

    def __init__(self) -> None:
        super().__init__("", markup=False)
        self._shown: object = None
        self._keys: list[BarKey] = []
        self._asked: tuple[Sequence[str], bool, str, int, Mapping[str, str], Mode] | None = None

    def show(
        self,
        scopes: Sequence[str],
        typing: bool,
        colour: str,
        columns: int,
        words: Mapping[str, str] = NO_OTHERS,
        mode: Mode = NO_MODE,
    ) -> None:
        """Show the keys of some scopes of the key table; while `typing`, those of a text field.

        `columns` is the width of the bar if it has not been laid out yet. `words` replaces words of the table, by the
        ids of the keys; a key whose word is empty is omitted. The keys of a `mode` come first.
        """
        self._asked = (scopes, typing, colour, columns, words, mode)
        width = (self.size.width or columns) - 2
        now = (scopes, typing, colour, width, words, mode)
        if now == self._shown or width < 1:
            return
        self._shown = now
        if typing:
            first, keys = [], [BarKey("enter", "OK", "enter", ""), BarKey("esc", "Cancel", "escape", "")]
        else:
            own = [key for scope in scopes for key in TABLE.get(scope, ())]
            known = {key.id: key for key in own}
            first = [_bar_key(known[id], word) for id, word in mode.keys.items() if id in known]
            others = [key for key in (*own, *TABLE["app"]) if key.id not in mode.keys]
            keys = list(bar_keys(others, words))
        self._keys = fitting_keys(first, keys, width)
        self.update(_line(self._keys, colour, len(first)), layout=False)

    def on_resize(self) -> None:
        """Fit the keys to the new width."""
        if self._asked is not None:
            self.show(*self._asked)

    def on_click(self, event: Click) -> None:
        """Press the key under the mouse."""
        end = 0
        for key in self._keys:
            begin, end = end, end + cell_len(f"{key.written} {key.word}") + len(GAP)
            if begin <= event.x - 1 < end:
                self.app.simulate_key(key.key)  # pyright: ignore[reportUnknownMemberType] -- Textual's App is generic


def fitting_keys(first: Sequence[BarKey], keys: Sequence[BarKey], columns: int) -> list[BarKey]:
    """The keys that fit: `FIRST_DROPPED` are left out first, then the pane's keys, other global keys, and mode keys."""
    kept = [*first, *keys]
    own = [each for each in keys if not each.id.startswith("app.")]
    everywhere = [each for each in keys if each.id.startswith("app.") and each.id != STOP]
    least = sorted(everywhere, key=lambda each: each.id not in FIRST_DROPPED)
    order = [
        *(each for each in least if each.id in FIRST_DROPPED),
        *sorted(reversed(own), key=lambda each: each.key == FILTER),
        *(each for each in least if each.id not in FIRST_DROPPED),
        *reversed(first),
    ]
    for each in order:
        if _line(kept).cell_len <= columns:
            break
        kept.remove(each)
    return kept


def bar_keys(keys: Iterable[Key], words: Mapping[str, str]) -> Iterator[BarKey]:
    """The keys that the bar shows, with their words."""
    for key in keys:
        word = words.get(key.id, key.footer)
        if key.footer and word:
            yield _bar_key(key, word)


def _bar_key(key: Key, word: str) -> BarKey:
    return BarKey(key.shown or key_text(key, 1), word, key.keys.split(",")[0], key.id)


def _line(keys: Iterable[BarKey], colour: str = "", first: int = 0) -> Text:
    """The keys and their words; the first `first` keys are highlighted."""
    text = Text(no_wrap=True)
    for at, each in enumerate(keys):
        text.append(GAP if text else "")
        text.append(each.written, Style(color=colour or None, bold=True, reverse=at < first))
        text.append(f" {each.word}", Style(bold=at < first))
    return text
