"""Actions on the log line at the cursor."""

from __future__ import annotations

from functools import partial
from typing import Any

from bot_console.tui.panes.list_pane import ListPane
from bot_console.tui.panes.logs.message_screen import LogMessageScreen
from bot_console.tui.panes.logs.preceding_events import options_of, preceding_events
from bot_console.tui.panes.logs.rows import LogRows
from bot_console.tui.widgets.prompt.question import Choice


class LinePane(ListPane):
    """A pane of log lines with actions on the one at the cursor."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._following = True
        """Whether the cursor follows the newest line."""

    @property
    def _list(self) -> LogRows:
        return self.query_one(LogRows)

    def action_detail(self) -> None:
        """Show the whole message."""
        record = self._list.named_record
        if record is not None:
            self.host.push_screen(LogMessageScreen(record))

    def action_instant(self) -> None:
        """Show the moment of the line in the plot and all other panes with a time axis."""
        record = self._list.record
        if record is not None:
            self._following = False
            self.time_cursor.move(record.stamp, self)
            self.post_message(self.PaneWanted("plot", ""))

    def action_edit(self) -> None:
        """Open the source location of the line in the user's editor."""
        record = self._list.record
        if record is None or not record.file:
            self.notify("No source location is known: the line was printed, or read from a file.")
        else:
            self.post_message(self.EditWanted(record.file, record.line))

    def action_before(self) -> None:
        """List the events just before the line; choosing one goes to it."""
        record = self._list.record
        if record is None:
            return
        events = self.console.snapshot().launch.timeline
        found = preceding_events(record.stamp, self.console.parameters.changes(-(10**9)), events)
        if not found:
            self.notify("No parameter was changed and nothing was launched before this line.")
            return

        def go(number: str) -> None:
            happened = found[int(number)]
            self._following = False
            self.time_cursor.move(happened.stamp, self)
            self.post_message(self.PaneWanted(happened.pane, ""))

        find = partial(options_of, found, record.stamp)
        self.ask(Choice(f"Before {record.text[:60]}", go, find=find, empty="No such event happened before."))

    def action_copy(self) -> None:
        """Copy the message through the terminal (OSC 52)."""
        record = self._list.record
        if record is not None:
            self.host.copy_to_clipboard(record.text)
            self.notify("Copied.")
