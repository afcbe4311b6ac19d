"""Changes that were made together share a row, and the timeline has a mark for each row."""

from __future__ import annotations

from dataclasses import replace

from bot_console.tui.console.model import Change, ChangeSource
from bot_console.tui.panes.history.sets import ChangeSet, group_changes
from bot_console.tui.panes.history.strip import time_strip

SECOND = 10**9


def change(seq: int, name: str, at: float, source: ChangeSource = ChangeSource.PROFILE, by: str = "outdoor") -> Change:
    return Change(seq, int(at * SECOND), "/robot", name, 1.0, 2.0, source, by=by)


def sizes(*changes: Change) -> list[int]:
    rows = group_changes(reversed(changes), (), lambda _: False)
    return [len(each.changes) if isinstance(each, ChangeSet) else 1 for each in rows]


def test_changes_of_one_operation_are_one_row() -> None:
    assert sizes(change(1, "a", 1.0), change(2, "b", 1.1), change(3, "c", 1.2)) == [3]


def test_other_operations_times_and_runs_are_separate_rows() -> None:
    assert sizes(change(1, "a", 1.0), change(2, "b", 1.1, by="indoor")) == [1, 1]
    assert sizes(change(1, "a", 1.0), change(2, "b", 9.0)) == [1, 1]
    assert sizes(replace(change(-1, "a", 1.0), run=5), change(0, "b", 1.1)) == [1, 1]


def test_repeating_an_operation_begins_a_new_row() -> None:
    assert sizes(change(1, "a", 1.0), change(2, "b", 1.1), change(3, "a", 1.2), change(4, "b", 1.3)) == [2, 2]


def test_single_edits_are_never_joined_but_an_undo_of_several_values_is() -> None:
    assert sizes(*(change(at, name, 1.0, ChangeSource.EDIT, "") for at, name in enumerate("abc"))) == [1, 1, 1]
    assert sizes(*(change(at, name, 1.0, ChangeSource.UNDO, "") for at, name in enumerate("abc"))) == [3]


def test_open_set_lists_its_changes_and_counts_the_unsafe_ones() -> None:
    changes = [change(2, "b", 1.1), change(1, "a", 1.0)]
    (row,) = group_changes(changes, (), lambda each: each.name == "a")
    assert isinstance(row, ChangeSet) and row.unsafe == 1
    rows = group_changes(changes, {row.key}, lambda _: False)
    assert rows[1:] == tuple(changes)
    grown = group_changes([change(3, "c", 1.2), *changes], {row.key}, lambda _: False)
    assert len(grown) == 4, "it stays open while changes are added"


def test_timeline_marks_changes_refusals_and_the_row_at_the_cursor() -> None:
    refused = replace(change(2, "b", 5.0, ChangeSource.EDIT, ""), accepted=False)
    rows = [change(3, "c", 11.0, ChangeSource.EDIT, ""), refused, change(1, "a", 1.0, ChangeSource.EDIT, "")]
    text = "".join(piece for piece, _ in time_strip(rows, rows[0], 41))
    cells = text[10:-10]
    assert cells == "▲───────✗───────────◆"
    assert "✗" not in "".join(piece for piece, _ in time_strip([rows[0], rows[2]], None, 41))


def test_nothing_is_drawn_for_a_single_moment_or_without_room() -> None:
    rows = [change(2, "b", 5.0), change(1, "a", 1.0)]
    assert time_strip(rows[:1], None, 80) == time_strip(rows, None, 20) == time_strip([], None, 80) == ()
