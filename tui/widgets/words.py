"""A text of fixed size that costs nothing while it stays the same."""

from __future__ import annotations

from bot_console.tui.text.shown import harmless
from rich.text import Text
from textual.widgets import Static


class Words(Static):
    """One line, or as many as its style gives it. What it says is made harmless; a longer line ends in an ellipsis."""

    DEFAULT_CSS = """
    Words { height: 1; padding: 0 1; color: $text-muted; background: $surface;
            text-wrap: nowrap; text-overflow: ellipsis; }
    """

    def __init__(self, *, id: str | None = None) -> None:
        super().__init__("", id=id, markup=False)
        self._said: str | Text = ""

    def say(self, what: str | Text) -> None:
        """Show a text: nothing is laid out anew, and nothing is drawn for the same text."""
        said = harmless(what) if isinstance(what, str) else what
        if said != self._said or (isinstance(said, Text) and said.spans != getattr(self._said, "spans", None)):
            self._said = said
            self.update(said, layout=False)
