"""A line of figures that change faster than a person can read."""

from __future__ import annotations

import re
import time
from collections.abc import Callable
from typing import Any, ClassVar

from bot_console.tui.text.redraw_interval import is_due
from bot_console.tui.widgets.static_text import StaticText
from rich.text import Text

FIGURE = re.compile(r" *[-+↶↷]?\d*(?:\.\d+|\d)")


class LiveFigures(StaticText):
    """Shows changed words at once, but changed figures at most every `EVERY_S`, so that they can be read."""

    EVERY_S: ClassVar[float] = 0.5
    """Minimum seconds for which figures are shown."""
    clock: Callable[[], float] = staticmethod(time.monotonic)
    """A monotonic clock (s); tests replace it with one that they step."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._live: str = ""
        self._newest: str = ""
        self._shown_at = float("-inf")
        self._heartbeats = False
        """Whether `heartbeat` is being called; without it, nothing would ever show delayed figures."""

    def show_live(self, text: str) -> None:
        """Show a text whose figures may be delayed."""
        self._newest = text
        if self._is_due() or _words(text) != _words(self._live):
            self._show_newest()

    def heartbeat(self) -> None:
        """Show delayed figures when they are due; called ten times a second."""
        self._heartbeats = True
        if self._newest != self._live and self._is_due():
            self._show_newest()

    def show_now(self, text: str) -> None:
        """Show a text that was explicitly requested."""
        self._newest = text
        self._show_newest()

    def _show_newest(self) -> None:
        if self._newest != self._live:
            self._live = self._newest
            self._shown_at = self.clock()
            self.show_text(self.styled(self._live))

    def _is_due(self) -> bool:
        return not self._heartbeats or is_due(self._shown_at, self.clock(), self.EVERY_S)

    def styled(self, text: str) -> str | Text:
        """The text as it is drawn."""
        return text


def _words(text: str) -> str:
    """The text without its figures, so that a figure that appears or disappears does not count as a changed word."""
    return " ".join(FIGURE.sub(" ", text).split())
