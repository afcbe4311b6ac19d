"""A line of figures that change faster than a person can read."""

from __future__ import annotations

import re
from typing import Any

from bot_console.tui.widgets.static_text import StaticText
from rich.text import Text

FIGURE = re.compile(r" *[-+↶↷]?\d*(?:\.\d+|\d)")


class LiveFigures(StaticText):
    """Shows changed words at once, and changed figures at most every `EVERY` ticks, so the newest may be delayed."""

    EVERY = 5
    """Ticks of the app, ten per second, for which figures stay before others replace them."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._live: str = ""
        self._newest: str = ""
        self._wait = 0
        self._heartbeats = False
        """Whether `heartbeat` is being called; without it, nothing would ever show delayed figures."""

    def show_live(self, text: str) -> None:
        """Show a text whose figures may be delayed."""
        self._newest = text
        if not (self._wait and _words(text) == _words(self._live)):
            self._show_newest()

    def heartbeat(self) -> None:
        """Show delayed figures when they are due; called ten times a second."""
        self._heartbeats = True
        self._wait = max(0, self._wait - 1)
        if not self._wait:
            self._show_newest()

    def show_now(self, text: str) -> None:
        """Show a text that was explicitly requested."""
        self._newest = text
        self._show_newest()

    def _show_newest(self) -> None:
        if self._newest != self._live:
            self._live = self._newest
            self._wait = self.EVERY if self._heartbeats else 0
            self.show_text(self.styled(self._live))

    def styled(self, text: str) -> str | Text:
        """The text as it is drawn."""
        return text


def _words(text: str) -> str:
    return FIGURE.sub("#", text)
