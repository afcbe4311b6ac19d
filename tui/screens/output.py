"""The screen with the output of a command."""

from __future__ import annotations

from collections.abc import Iterable

from bot_console.tui.screens.overlay import Overlay
from bot_console.tui.text.sanitize import sanitize
from rich.console import RenderableType
from rich.text import Text


class OutputScreen(Overlay):
    """Shows a command and its output, as printed."""

    def __init__(self, command: str, output: str) -> None:
        super().__init__(command)
        self._output = output

    def content(self) -> Iterable[RenderableType]:
        """The output."""
        yield Text("\n".join(sanitize(line) for line in self._output.splitlines()) or "(no output)")
