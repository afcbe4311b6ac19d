"""The log of the running system as a source for the log pane."""

from __future__ import annotations

from bot_console.tui.console.logs.port import LogView
from bot_console.tui.console.model import LogFilter, LogRecord, LogState
from bot_console.tui.console.protocol import Console


class LiveLog:
    """The log of the running system; implements `tui.console.logs.port.LogSource`."""

    name = ""

    def __init__(self, console: Console) -> None:
        self._console = console

    @property
    def state(self) -> LogState:
        """The range and counts of the stored records."""
        return self._console.snapshot().logs

    def record(self, seq: int) -> LogRecord | None:
        """The record with that number."""
        return self._console.logs.record(seq)

    def view(self, which: LogFilter, instead_of: LogView | None = None) -> LogView:
        """Search for the records that pass a filter."""
        return self._console.logs.view(which, instead_of)

    def clear(self) -> None:
        """Forget all records."""
        self._console.logs.clear()

    def close(self) -> None:
        """Do nothing: the system's log stays open."""
