"""Finds the values that this console has set and that are in no file."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from bot_console.tui.console.model import ChangeSource, Value, same

IN_A_FILE = (ChangeSource.PROFILE, ChangeSource.FILE)
UNDONE = ChangeSource.UNDO


class UnsavedValues:
    """Knows the values to which each parameter that was set here can be restored without typing.

    These are the start value, the values of profiles and files, and saved values.
    """

    def __init__(self) -> None:
        self._safe: dict[tuple[str, str], list[Value]] = {}
        self._now: dict[tuple[str, str], Value] = {}

    def moved(self, node: str, before: Mapping[str, Value], after: Mapping[str, Value], source: ChangeSource) -> None:
        """Record that values of a node changed from `before` to `after`, or back by an undo."""
        for name, value in (before if source is UNDONE else after).items():
            key = (node, name)
            safe = self._safe.setdefault(key, [before[name]])
            self._now[key] = value
            if source in IN_A_FILE:
                safe.append(value)

    def saved(self, nodes: Collection[str]) -> None:
        """Record that the values of some nodes, or of all if none is named, are now in a file."""
        for key, value in self._now.items():
            if not nodes or key[0] in nodes:
                self._safe[key].append(value)

    def restarted(self, node: str, name: str) -> None:
        """Record that a parameter has its start value again."""
        self._now.pop((node, name), None)
        self._safe.pop((node, name), None)

    @property
    def names(self) -> tuple[tuple[str, str], ...]:
        """Node and name of each value that is in no file, sorted."""
        return tuple(
            sorted(key for key, value in self._now.items() if not any(same(value, each) for each in self._safe[key]))
        )
