"""Changes that were made together, such as those of a profile, as one row of the history. Pure."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from bot_console.tui.console.model import Change, ChangeSource

MAX_GAP_NS = 1_000_000_000
"""Maximum nanoseconds between two consecutive changes of a set."""
ALWAYS_SETS = (ChangeSource.HISTORY, ChangeSource.UNDO, ChangeSource.REDO, ChangeSource.ROLLBACK)
"""Sources whose changes are grouped although the operation has no name."""


@dataclass(frozen=True)
class ChangeSet:
    """Changes that were made together, newest first."""

    changes: tuple[Change, ...]
    unsafe: int = 0
    """Number of changes that made the robot less safe."""
    opened: bool = False

    @property
    def stamp(self) -> int:
        """When the newest change was made (ns since the epoch)."""
        return self.changes[0].stamp

    @property
    def newest(self) -> Change:
        """The newest change."""
        return self.changes[0]

    @property
    def key(self) -> tuple[str, int]:
        """The identity of the set, which stays the same while changes are added."""
        return "set", self.changes[-1].seq


HistoryRow: TypeAlias = "Change | ChangeSet"


def group_changes(
    changes: Iterable[Change], opened: Collection[tuple[str, int]], is_unsafe: Callable[[Change], bool]
) -> tuple[HistoryRow, ...]:
    """Group changes (newest first) into rows: one for each set, followed by its changes if it is open."""
    rows: list[HistoryRow] = []
    for run in _runs(changes):
        if len(run) < 2:
            rows += run
            continue
        found = ChangeSet(tuple(run), sum(map(is_unsafe, run)))
        is_open = found.key in opened
        rows.append(ChangeSet(found.changes, found.unsafe, is_open))
        rows += run if is_open else ()
    return tuple(rows)


def changes_of(row: HistoryRow) -> Sequence[Change]:
    """The changes of a row."""
    return row.changes if isinstance(row, ChangeSet) else (row,)


def _runs(changes: Iterable[Change]) -> list[list[Change]]:
    found: list[list[Change]] = []
    names: set[tuple[str, str]] = set()
    for each in changes:
        name = (each.node, each.name)
        if found and _made_together(found[-1][-1], each) and name not in names:
            found[-1].append(each)
            names.add(name)
        else:
            found.append([each])
            names = {name}
    return found


def _made_together(newer: Change, older: Change) -> bool:
    """Whether two consecutive changes were made by the same operation."""
    operations = [(each.source, each.by, each.run, each.seq < 0) for each in (newer, older)]
    named = bool(newer.by) or newer.source in ALWAYS_SETS
    return named and operations[0] == operations[1] and 0 <= newer.stamp - older.stamp <= MAX_GAP_NS
