"""Announcements of edits, including undone ones, that made the robot less safe, with a way back."""

from __future__ import annotations

from collections.abc import Sequence

from bot_console.tui.console.model import Change, ChangeSource, ConsoleSnapshot, same
from bot_console.tui.console.parameters.port import Parameters
from bot_console.tui.console.parameters.safety import takes_safety
from bot_console.tui.text.value_text import value_text

BACK = {ChangeSource.EDIT: "u", ChangeSource.REDO: "u", ChangeSource.UNDO: "U"}
"""The sources of changes that are announced, with the key that takes each back; for others, a question is asked
before.
"""
MAX_WAITING_CALLS = 10
"""Calls, ten per second, for which a change may wait until a key can take it back: other nodes of the same set may
still refuse it, which takes it back automatically.
"""


class SafetyNews:
    """Follows the journal; a parameter that keeps changing the same way, as when nudged, is announced once."""

    def __init__(self, parameters: Parameters) -> None:
        self._parameters = parameters
        self._end: int | None = None
        self._reported: set[tuple[str, str]] = set()
        self._waiting: dict[tuple[str, str], tuple[Change, str, int]] = {}
        """Changes not announced yet, each with how it makes the robot less safe, and the number of calls since then."""

    def since(self, snapshot: ConsoleSnapshot) -> Sequence[str]:
        """The announcements about edits since the last call."""
        before, self._end = self._end, snapshot.journal.end
        if before is not None and before != self._end:
            for each in self._parameters.changes(before):
                self._notice(each, snapshot)
        return [text for key in [*self._waiting] if (text := self._news(key, snapshot))]

    def _notice(self, change: Change, snapshot: ConsoleSnapshot) -> None:
        """Queue a change that is to be announced."""
        tree = snapshot.parameters.get(change.node)
        parameter = tree.get(change.name) if tree else None
        if parameter is None or not change.accepted:
            return
        key, why = (change.node, change.name), takes_safety(parameter, change.old, change.new)
        self._waiting.pop(key, None)
        if not why:
            self._reported.discard(key)
        elif key not in self._reported and change.source in BACK:
            self._waiting[key] = change, why, 0

    def _news(self, key: tuple[str, str], snapshot: ConsoleSnapshot) -> str:
        """The text about a queued change, once it is certain what takes it back; empty until then."""
        change, why, calls = self._waiting[key]
        journal = snapshot.journal
        goes_back = key in (journal.redoes if change.source is ChangeSource.UNDO else journal.undoes)
        if not goes_back and calls < MAX_WAITING_CALLS:
            self._waiting[key] = change, why, calls + 1
            return ""
        del self._waiting[key]
        tree = snapshot.parameters.get(change.node)
        parameter = tree.get(change.name) if tree else None
        if parameter is None or not same(parameter.value, change.new):
            return ""  # it has been taken back already
        self._reported.add(key)
        values = f"{value_text(change.old)} → {value_text(change.new)}"
        way_back = f"{BACK[change.source]} in the Parameters pane" if goes_back else "b in the History pane"
        return f"⚠ {change.name} {values} {why}. {way_back} undoes it."
