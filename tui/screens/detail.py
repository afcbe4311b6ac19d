"""A log message in full."""

from __future__ import annotations

import time

from bot_console.tui.console.model import LogRecord
from bot_console.tui.format import harmless
from rich.text import Text
from textual.app import ComposeResult
from textual.containers import VerticalScroll
from textual.screen import ModalScreen
from textual.widgets import Static


class DetailScreen(ModalScreen[None]):
    """Everything that is known of one log line."""

    BINDINGS = [("escape,enter,q", "dismiss", "Close")]
    DEFAULT_CSS = """
    DetailScreen { align: center middle; }
    DetailScreen VerticalScroll { width: 90%; max-width: 110; height: auto; max-height: 80%; background: $panel;
                                  border: round $primary; padding: 0 1; }
    """

    def __init__(self, record: LogRecord) -> None:
        super().__init__()
        self._record = record

    def compose(self) -> ComposeResult:
        """The facts, then the text."""
        record = self._record
        seconds, rest = divmod(record.stamp, 10**9)
        stamp = time.strftime("%Y-%m-%d %H:%M:%S", time.localtime(seconds)) + f".{rest:09d}"
        text = Text(f"{record.severity.name}  {harmless(record.node)}\n", "bold")
        text.append(f"{stamp}\n", "not bold dim")
        if record.file:
            text.append(f"{harmless(record.file)}:{record.line} in {harmless(record.function)}\n", "not bold dim")
        text.append("\n" + "\n".join(harmless(line) for line in record.text.splitlines()), "not bold")
        with VerticalScroll() as box:
            box.border_title = "Message"
            box.border_subtitle = "esc closes"
            yield Static(text)
