"""The rows of the history: time, parameter, old and new value, source, and reason of a refusal."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence

from bot_console.tui.console.filter_syntax import Query
from bot_console.tui.console.model import Change, ChangeSource, Kind, ParameterInfo, Value
from bot_console.tui.format import clock_text, command_of
from bot_console.tui.panes.history.sets import ChangeSet, HistoryRow, changes_of
from bot_console.tui.text.bars import bars
from bot_console.tui.text.counted import counted
from bot_console.tui.text.refusals import verdict_of_change
from bot_console.tui.text.sanitize import cut, sanitize
from bot_console.tui.text.value_text import value_text
from bot_console.tui.widgets.item_list import ItemList
from rich.cells import cell_len
from rich.segment import Segment
from rich.text import Text

WHO = {
    ChangeSource.EDIT: "this console",
    ChangeSource.UNDO: "undo",
    ChangeSource.REDO: "redo",
    ChangeSource.PROFILE: "profile",
    ChangeSource.FILE: "file",
    ChangeSource.HISTORY: "history",
    ChangeSource.ROLLBACK: "rolled back",
    ChangeSource.OTHER: "another program or the node",
}
MARKS = {"": " ", "refused": "✗", "not set": "?"}
"""The mark before an entry, by its verdict."""
GAP = "  "
MAX_NODE_CELLS, MAX_NAME_CELLS, MAX_VALUES_CELLS = 18, 24, 22
"""Maximum cells of the node, the name and the values."""
MAX_SPARED_CELLS = 8
"""Maximum cells by which each of these columns shrinks where a row is too narrow."""
TAIL_CELLS = 16
"""Cells reserved for the source of a change, or the reason of a refusal."""
MOMENT_CELLS, MARK_CELLS = 12, 2
BARS_CELLS = 4
"""Cells of the old and the new value as bars, with a gap; the first column to be left out."""
INDENT = "  "
"""The text before the name of a change of an open set."""
MIN_CELLS_WITH_NODE = 70
"""Minimum cells of a row that names the node; in narrower panes only the details at the cursor do."""


def source_text(change: Change) -> str:
    """Who made a change, and the operation it was part of."""
    if change.source is ChangeSource.OTHER and change.by:
        return change.by  # more precise than "another program or the node"
    return f"{WHO[change.source]} {change.by}".rstrip()


def searched_text(change: Change) -> str:
    """The text that a filter searches, besides the node."""
    verdict = verdict_of_change(change) or "taken"
    values = f"{value_text(change.old)} {value_text(change.new)}"
    return f"{change.name} {values} {source_text(change)} {verdict} {change.reason}"


def day_text(stamp: int) -> str:
    """Date and time (local) without the year, as shown for changes of earlier runs."""
    return time.strftime("%m-%d %H:%M", time.localtime(stamp // 10**9))


def _moment(change: Change) -> str:
    return day_text(change.stamp) if change.seq < 0 else clock_text(change.stamp)[:8]


def changed_text(change: Change) -> str:
    """The old and the new value of a change."""
    return f"{sanitize(value_text(change.old))} → {sanitize(value_text(change.new))}"


def param_set_line(change: Change, value: Value) -> str:
    """The `ros2` command line that sets the parameter of a change to a value."""
    of_bytes = isinstance(value, tuple) and any(isinstance(each, bytes) for each in value)
    kind = Kind.BYTE_ARRAY if of_bytes else Kind.NOT_SET
    return command_of(ParameterInfo(change.node, change.name, kind, value), value)


def details(change: Change, effect: str) -> Text:
    """Everything known about a change."""
    text = Text(no_wrap=False, overflow="fold")
    if not change.accepted:
        verdict = f"{value_text(change.new)} was {verdict_of_change(change)}: {change.reason}"
        text.append(f"{MARKS[verdict_of_change(change)]} {sanitize(verdict)}\n", "bold")
    at = time.strftime("%Y-%m-%d ", time.localtime(change.stamp // 10**9)) + clock_text(change.stamp)
    text.append(f"{sanitize(change.node)} {sanitize(change.name)}  {changed_text(change)}\n")
    text.append(f"{at} · {sanitize(source_text(change))}{' · an earlier run' if change.seq < 0 else ''}", "dim")
    text.append(f" · after it {effect}\n" if effect else "\n", "dim")
    text.append(sanitize(param_set_line(change, change.new)), "dim italic")
    return text


def set_text(row: ChangeSet) -> str:
    """The number of values in a set, and how many of them are less safe or were not set."""
    refused = sum(not each.accepted for each in row.changes)
    text = counted(len(row.changes), "value")
    text += f", {row.unsafe} less safe" if row.unsafe else ""
    return text + (f", {refused} refused or not set" if refused else "")


def set_details(row: ChangeSet) -> Text:
    """Everything known about a set: its source, its times, and the names of its parameters."""
    text = Text(no_wrap=False, overflow="fold")
    begin, end = clock_text(row.changes[-1].stamp), clock_text(row.stamp)
    text.append(f"{sanitize(source_text(row.newest))}  {set_text(row)}\n", "bold")
    keys = "Enter lists them, u goes back to just after them"
    text.append(f"{day_text(row.stamp)[:5]} {begin} .. {end} · {keys}\n", "dim")
    text.append(", ".join(dict.fromkeys(sanitize(each.name) for each in reversed(row.changes))), "dim")
    return text


class ChangeRows(ItemList[HistoryRow]):
    """Changes and sets of changes, newest first."""

    def __init__(self, effect: Callable[[int], str]) -> None:
        """Create the list; `effect` returns a text on what followed the change with a number, or an empty one."""
        super().__init__()
        self._effect = effect
        self._node = self._name = self._values = 0
        self._members: frozenset[int] = frozenset()
        """The numbers of the changes that are listed below their set."""

    def key(self, item: HistoryRow) -> object:
        """The key of a set, or the number of a change, wherever it is listed."""
        return item.key if isinstance(item, ChangeSet) else item.seq

    def exchange(self, rows: Sequence[HistoryRow], *, stay: bool = True) -> None:
        """Show these rows; the cursor stays on its row, or on the newest one if it was there."""
        before = self._node, self._name, self._values
        single = [each for each in rows if not isinstance(each, ChangeSet)]
        sets = [each for each in rows if isinstance(each, ChangeSet)]
        self._members = frozenset(each.seq for found in sets if found.opened for each in found.changes)
        self._node = min(MAX_NODE_CELLS, max((len(each.node) for each in single), default=0))
        self._name = min(
            MAX_NAME_CELLS, max((len(each.name) for each in single), default=0) + (len(INDENT) if sets else 0)
        )
        self._values = min(MAX_VALUES_CELLS, max((len(changed_text(each)) for each in single[:200]), default=0))
        super().exchange(rows, stay=stay and self.cursor > 0)
        if (self._node, self._name, self._values) != before:
            self.refresh()

    def matches(self, index: int, query: Query) -> bool:
        """Whether a change, or one of a set, matches a filter."""
        return any(query.matches(searched_text(each), each.node) for each in changes_of(self.rows[index]))

    def _widths(self, width: int) -> tuple[int, int, int]:
        """The cells of node, name and values in a row of `width` cells; a narrow row has no node."""
        node = self._node if width >= MIN_CELLS_WITH_NODE else 0
        taken = MOMENT_CELLS + MARK_CELLS + sum(each + len(GAP) for each in (node, self._name, self._values) if each)
        missing = max(0, taken + TAIL_CELLS - width)
        found: list[int] = []
        for each in (node, self._values, self._name):
            given = min(missing, MAX_SPARED_CELLS, max(0, each - MAX_SPARED_CELLS))
            missing -= given
            found.append(each - given)
        return found[0], found[2], found[1]

    def _bars(self, change: Change, width: int) -> list[Segment]:
        """The old and the new value as bars, if there is room."""
        taken = MOMENT_CELLS + MARK_CELLS + sum(each + len(GAP) for each in self._widths(width) if each)
        if width < taken + BARS_CELLS + 2 * TAIL_CELLS:
            return []
        text = "".join(bars((change.old, change.new)))
        return [Segment(text + " " * (BARS_CELLS - len(text)), self.row_style("dim" if change.accepted else "error"))]

    def _set(self, row: ChangeSet, width: int) -> list[Segment]:
        """A set: who made it, and how many values it has."""
        bad = any(not each.accepted for each in row.changes)
        sign, loud = "▾" if row.opened else "▸", self.row_style("error" if bad else "warn" if row.unsafe else "dim")
        return [
            Segment(f"{_moment(row.newest):<{MOMENT_CELLS}}", self.row_style("dim")),
            Segment(f"{sign} ", self.row_style("dim")),
            Segment(sanitize(source_text(row.newest)) + GAP, self.row_style("strong")),
            Segment(set_text(row), loud),
            *self._after(
                row.newest,
                width - MOMENT_CELLS - MARK_CELLS - cell_len(f"{source_text(row.newest)}{GAP}{set_text(row)}"),
            ),
        ]

    def _after(self, change: Change, room: int) -> list[Segment]:
        """The effect of a change, if all of it fits into `room` cells."""
        text = self._effect(change.seq)
        fits = text and cell_len(text) + len(GAP) <= room
        return [Segment(f"{GAP}{text}", self.row_style("good"))] if fits else []

    def row(self, index: int, width: int) -> list[Segment]:
        """One change, or a set."""
        change = self.rows[index]
        dim = self.row_style("dim")
        if isinstance(change, ChangeSet):
            return self._set(change, width)
        of_node, of_name, of_values = self._widths(width)
        moment = _moment(change)
        node = sanitize(change.node)
        node = cut("…" + node[1 - of_node :] if len(node) > of_node else node, of_node, pad=True)
        head = [Segment(f"{moment:<{MOMENT_CELLS}}", dim)]
        if of_node:
            head.append(Segment(node + GAP, dim))
        name = cut((INDENT if change.seq in self._members else "") + sanitize(change.name), of_name, pad=True)
        mark = MARKS[verdict_of_change(change)]
        values = cut(changed_text(change), of_values, pad=True)
        refused = self.row_style("error")
        tail = (
            f"{sanitize(change.reason)} ({sanitize(source_text(change))})"
            if not change.accepted
            else sanitize(source_text(change))
        )
        segments = [
            *head,
            Segment(f"{mark} ", refused),
            Segment(name + GAP, self.row_style("plain") if change.accepted else refused),
            Segment(values + GAP, self.row_style("strong") if change.accepted else refused),
            *self._bars(change, width),
            Segment(tail, dim if change.accepted else refused),
        ]
        return [*segments, *self._after(change, width - sum(each.cell_length for each in segments))]
