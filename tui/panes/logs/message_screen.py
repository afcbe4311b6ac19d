"""The screen with one complete log message."""

from __future__ import annotations

import time
from collections.abc import Iterable

from bot_console.tui.console.model import LogRecord
from bot_console.tui.screens.overlay import Overlay
from bot_console.tui.text.sanitize import sanitize
from rich.console import RenderableType
from rich.text import Text


class LogMessageScreen(Overlay):
    """Shows one log line with everything known about it."""

    def __init__(self, record: LogRecord) -> None:
        super().__init__("Message")
        self._record = record

    def content(self) -> Iterable[RenderableType]:
        """The facts, then the text."""
        record = self._record
        seconds, rest = divmod(record.stamp, 10**9)
        stamp = time.strftime("%Y-%m-%d %H:%M:%S", time.localtime(seconds)) + f".{rest:09d}"
        text = Text(f"{record.severity.name}  {sanitize(record.node)}\n", "bold")
        text.append(f"{stamp}  number {record.seq + 1}\n", "not bold dim")
        if record.file:
            text.append(f"{sanitize(record.file)}:{record.line} in {sanitize(record.function)}\n", "not bold dim")
        text.append("\n" + "\n".join(sanitize(line) for line in record.text.splitlines()), "not bold")
        yield text
