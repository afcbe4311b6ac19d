"""What a command line printed."""

from __future__ import annotations

from bot_console.tui.format import harmless
from rich.text import Text
from textual.app import ComposeResult
from textual.containers import VerticalScroll
from textual.screen import ModalScreen
from textual.widgets import Static


class OutputScreen(ModalScreen[None]):
    """A command and its output, as printed."""

    BINDINGS = [("escape,enter,q", "dismiss", "Close")]
    DEFAULT_CSS = """
    OutputScreen { align: center middle; }
    OutputScreen VerticalScroll { width: 90%; height: auto; max-height: 80%; background: $panel;
                                  border: round $primary; padding: 0 1; }
    """

    def __init__(self, command: str, output: str) -> None:
        super().__init__()
        self._command = command
        self._output = output

    def compose(self) -> ComposeResult:
        """The output below the command."""
        with VerticalScroll() as box:
            box.border_title = harmless(self._command)
            box.border_subtitle = "esc closes"
            yield Static(Text("\n".join(harmless(line) for line in self._output.splitlines()) or "(no output)"))
