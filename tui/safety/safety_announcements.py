"""Announcements of edits, including undone ones, that made the robot less safe, with a way back."""

from __future__ import annotations

from collections.abc import Sequence

from bot_console.tui.console.model import Change, ChangeSource, ConsoleSnapshot, same
from bot_console.tui.console.parameters.port import Parameters
from bot_console.tui.console.parameters.safety import takes_safety
from bot_console.tui.text.value_text import value_text

UNDO_KEYS = {ChangeSource.EDIT: "u", ChangeSource.REDO: "u", ChangeSource.UNDO: "U"}
"""The sources of changes that are announced, with the key that undoes each; other changes are confirmed beforehand."""
MAX_WAITING_CALLS = 10
"""Maximum number of calls, ten per second, for which an announcement waits until a key can undo the change: another
node may still refuse its part of the same edit, which undoes the change automatically.
"""


class SafetyAnnouncements:
    """Finds edits in the journal to announce; a parameter that keeps changing in one direction is announced once."""

    def __init__(self, parameters: Parameters) -> None:
        self._parameters = parameters
        self._end: int | None = None
        self._reported: set[tuple[str, str]] = set()
        self._waiting: dict[tuple[str, str], tuple[Change, str, int]] = {}
        """Changes not announced yet, each with how it makes the robot less safe, and the number of calls since then."""

    def announcements(self, snapshot: ConsoleSnapshot) -> Sequence[str]:
        """The announcements about edits since the last call."""
        before, self._end = self._end, snapshot.journal.end
        if before is not None and before != self._end:
            for each in self._parameters.changes(before):
                self._queue(each, snapshot)
        return [text for key in [*self._waiting] if (text := self._announcement(key, snapshot))]

    def _queue(self, change: Change, snapshot: ConsoleSnapshot) -> None:
        """Queue a change for announcement if it made the robot less safe."""
        tree = snapshot.parameters.get(change.node)
        parameter = tree.get(change.name) if tree else None
        if parameter is None or not change.accepted:
            return
        key, why = (change.node, change.name), takes_safety(parameter, change.old, change.new)
        self._waiting.pop(key, None)
        if not why:
            self._reported.discard(key)
        elif key not in self._reported and change.source in UNDO_KEYS:
            self._waiting[key] = change, why, 0

    def _announcement(self, key: tuple[str, str], snapshot: ConsoleSnapshot) -> str:
        """The announcement of a queued change, once it is certain what undoes it; empty until then."""
        change, why, calls = self._waiting[key]
        journal = snapshot.journal
        can_undo = key in (journal.redoes if change.source is ChangeSource.UNDO else journal.undoes)
        if not can_undo and calls < MAX_WAITING_CALLS:
            self._waiting[key] = change, why, calls + 1
            return ""
        del self._waiting[key]
        tree = snapshot.parameters.get(change.node)
        parameter = tree.get(change.name) if tree else None
        if parameter is None or not same(parameter.value, change.new):
            return ""  # it has been undone already
        self._reported.add(key)
        values = f"{value_text(change.old)} → {value_text(change.new)}"
        way_back = f"{UNDO_KEYS[change.source]} in the Parameters pane" if can_undo else "b in the History pane"
        return f"⚠ {change.name} {values} {why}. {way_back} undoes it."
