"""Announcements of edits, including undone ones, that made the robot less safe, with a way back."""

from __future__ import annotations

from collections.abc import Sequence

from bot_console.tui.console.model import Change, ChangeSource, ConsoleSnapshot
from bot_console.tui.console.parameters.port import Parameters
from bot_console.tui.console.parameters.safety import takes_safety
from bot_console.tui.format import value_text

BACK = {ChangeSource.EDIT: "u", ChangeSource.REDO: "u", ChangeSource.UNDO: "U"}
"""The sources of the changes that are told of, with the key that takes each back; others are asked about before."""


class SafetyNews:
    """Follows the journal; a parameter that keeps changing the same way, as when nudged, is announced once."""

    def __init__(self, parameters: Parameters) -> None:
        self._parameters = parameters
        self._end: int | None = None
        self._reported: set[tuple[str, str]] = set()

    def since(self, snapshot: ConsoleSnapshot) -> Sequence[str]:
        """What to announce of the edits since the last call."""
        before, self._end = self._end, snapshot.journal.end
        if before is None or before == self._end:
            return ()
        changes = self._parameters.changes(before)
        return [text for each in changes if (text := self._news(each, snapshot))]

    def _news(self, change: Change, snapshot: ConsoleSnapshot) -> str:
        tree = snapshot.parameters.get(change.node)
        parameter = tree.get(change.name) if tree else None
        if parameter is None or not change.accepted:
            return ""
        key, why = (change.node, change.name), takes_safety(parameter, change.old, change.new)
        reported = key in self._reported
        if not why:
            self._reported.discard(key)
        if not why or reported or change.source not in BACK:
            return ""
        self._reported.add(key)
        values = f"{value_text(change.old)} → {value_text(change.new)}"
        return f"⚠ {change.name} {values} {why}. {BACK[change.source]} in the Parameters pane takes it back."
