"""Help for the focused pane, made from the key table."""

from __future__ import annotations

from bot_console.tui.keymap import TABLE, Key
from rich.table import Table
from rich.text import Text
from textual.app import ComposeResult
from textual.containers import VerticalScroll
from textual.screen import ModalScreen
from textual.widgets import Static


class HelpScreen(ModalScreen[None]):
    """What a pane is for, and its keys, then those that work everywhere."""

    BINDINGS = [("escape,q,question_mark,f1", "dismiss", "Close")]
    DEFAULT_CSS = """
    HelpScreen { align: center middle; }
    HelpScreen VerticalScroll { width: 90%; max-width: 90; height: auto; max-height: 90%; background: $panel;
                                border: round $primary; padding: 0 1; }
    """

    def __init__(self, scope: str, title: str, text: str) -> None:
        super().__init__()
        self._scope = scope
        self._title = title
        self._text = text

    def compose(self) -> ComposeResult:
        """The text, then two tables of keys."""
        with VerticalScroll() as box:
            box.border_title = self._title or "Help"
            box.border_subtitle = "esc closes"
            if self._text:
                yield Static(Text(self._text + "\n", "dim"))
            if self._scope in TABLE:
                yield Static(_keys(TABLE[self._scope]))
            yield Static(Text("\nEverywhere", "bold"))
            yield Static(_keys((*TABLE["app"], *TABLE["list"])))


def _keys(rows: tuple[Key, ...]) -> Table:
    table = Table.grid(padding=(0, 2))
    table.add_column(style="bold", justify="right", min_width=12)
    table.add_column()
    for key in rows:
        table.add_row(Text(key_text(key)), Text(key.text))
    return table


NAMES = {
    "question_mark": "?",
    "colon": ":",
    "exclamation_mark": "!",
    "slash": "/",
    "plus": "+",
    "equals_sign": "=",
    "minus": "-",
    "greater_than_sign": ">",
    "less_than_sign": "<",
}


def key_text(key: Key) -> str:
    """The keys of an action as they are written on the keyboard."""
    return " ".join(NAMES.get(each, each.replace("ctrl+", "^")) for each in key.keys.split(","))
