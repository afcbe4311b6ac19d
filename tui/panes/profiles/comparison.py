"""Compares profiles: the columns are profiles, the rows the parameters in which they differ, riskiest first."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

from bot_console.tui.console.model import ConsoleSnapshot, ParameterInfo, Profile, ProfileDifference, Value
from bot_console.tui.console.parameters.described_unit import unit_in_description
from bot_console.tui.console.parameters.safety import importance
from bot_console.tui.text.bars import bars
from bot_console.tui.text.sanitize import cut, sanitize
from bot_console.tui.text.value_text import value_text
from bot_console.tui.widgets.item_list import ItemList
from bot_console.tui.widgets.picture import Line
from rich.cells import cell_len
from rich.segment import Segment

MIN_COLUMN, MAX_COLUMN = 12, 18
"""Minimum and maximum cells of a profile's column."""
NAME_CELLS, UNIT_CELLS, NODE_CELLS = 22, 6, 24
"""Cells of a parameter's name, its unit, and its node, which is the first to be left out."""
LAST = 9
"""The rank of parameters that have no importance for safety."""


@dataclass(frozen=True)
class Cell:
    """The value that a profile gives a parameter; `mark` is ⚠ if it is less safe than now, ✗ if it is refused."""

    value: Value
    mark: str = ""
    bar: str = " "
    stays: bool = False


@dataclass(frozen=True)
class ComparedValue:
    """A parameter in which profiles differ, of one node or several, with its value now and in each profile."""

    nodes: tuple[str, ...]
    name: str
    unit: str
    cells: tuple[Cell, ...]


@dataclass(frozen=True)
class Comparison:
    """The titles of the columns, of which the first is the running system, and the rows."""

    titles: tuple[str, ...] = ()
    rows: tuple[ComparedValue, ...] = ()
    left_out: int = 0
    """Number of profiles for whose columns there is no room."""
    shown: int = -1
    """The column of the selected profile; 0 if no profile is."""


def columns_in(width: int) -> int:
    """The number of columns that fit into a width (cells): at least the running system and one profile."""
    return max(2, (width - NAME_CELLS - UNIT_CELLS) // MIN_COLUMN)


def compare_profiles(
    snapshot: ConsoleSnapshot,
    profiles: Sequence[Profile],
    selected: Profile | None,
    differences: Callable[[str], Sequence[ProfileDifference]],
    width: int,
) -> Comparison:
    """Compare the running system with as many profiles as fit, always including the selected one.

    Launch profiles and unreadable files are left out, as they have no values. `differences` returns what applying a
    profile would change.
    """
    current = snapshot.active_profile
    unchanged = bool(current) and not snapshot.profile_changes
    usable = [each for each in profiles if not (each.problem or each.launch or (unchanged and each.name == current))]
    room = columns_in(width) - 1
    names = [each.name for each in usable]
    chosen = names.index(selected.name) if selected is not None and selected.name in names else -1
    first = max(0, min(chosen - room + 1, len(names) - room))
    visible = names[first : first + room]
    titles = (f"● {current}" if unchanged else "now", *(f"● {each}" if each == current else each for each in visible))
    changes = [{(each.node, each.name): each for each in differences(name) if not each.unknown} for name in visible]
    keys = dict.fromkeys(key for each in changes for key in each)
    trees = snapshot.parameters
    found = [
        (_rank(parameter, changes), _row(parameter, changes))
        for node, name in keys
        if node in trees and (parameter := trees[node].get(name)) is not None
    ]
    found.sort(key=lambda each: (each[0], each[1].name, each[1].nodes))
    shown = 0 if chosen < 0 else chosen - first + 1
    return Comparison(titles, _merge_nodes(row for _, row in found), len(names) - len(visible), shown)


def _merge_nodes(rows: Iterable[ComparedValue]) -> tuple[ComparedValue, ...]:
    """Merge the rows of nodes that have the same parameter with the same values."""
    found: dict[tuple[str, str, tuple[Cell, ...]], ComparedValue] = {}
    for row in rows:
        key = (row.name, row.unit, row.cells)
        before = found.get(key)
        found[key] = row if before is None else replace(before, nodes=before.nodes + row.nodes)
    return tuple(found.values())


_Changes = Mapping[tuple[str, str], ProfileDifference]


def _rank(parameter: ParameterInfo, changes: Sequence[_Changes]) -> tuple[bool, int]:
    """Sort key: parameters that a profile makes less safe, then those that matter most to how the robot drives."""
    key = (parameter.node, parameter.name)
    unsafe = any(key in each and each[key].unsafe for each in changes)
    rank = importance(parameter)
    return not unsafe, LAST if rank is None else rank


def _row(parameter: ParameterInfo, changes: Sequence[_Changes]) -> ComparedValue:
    key = (parameter.node, parameter.name)
    found = [each.get(key) for each in changes]
    values = [parameter.value, *(parameter.value if each is None else each.then for each in found)]
    drawn = bars(values)
    cells = [Cell(parameter.value, bar=drawn[0])]
    for value, bar, each in zip(values[1:], drawn[1:], found, strict=True):
        mark = "" if each is None else "✗" if each.refusal else "⚠" if each.unsafe else ""
        cells.append(Cell(value, mark, bar, each is None))
    return ComparedValue((parameter.node,), parameter.name, unit_in_description(parameter.description), tuple(cells))


class ComparisonRows(ItemList[ComparedValue]):
    """The parameters in which profiles differ, with a column for each profile."""

    can_focus = False

    def __init__(self) -> None:
        super().__init__()
        self.comparison = Comparison()
        self._repeated: set[str] = set()

    def key(self, item: ComparedValue) -> object:
        """The nodes and the name of the parameter."""
        return item.nodes, item.name

    def show(self, comparison: Comparison) -> None:
        """Show a comparison."""
        before, self.comparison = self.comparison, comparison
        counts = Counter(each.name for each in comparison.rows)
        self._repeated = {name for name, count in counts.items() if count > 1}
        self.exchange(comparison.rows)
        if (before.titles, before.shown) != (comparison.titles, comparison.shown):
            self.refresh()

    def heading(self, width: int) -> Line:
        """The titles of the columns, with the selected profile in the accent colour."""
        names, across, nodes = self._columns(width)
        parts = [(" " * (names + UNIT_CELLS), "")]
        for at, title in enumerate(self.comparison.titles):
            text = cut(sanitize(title), across - 1)
            parts += [
                (" " * (across - 1 - cell_len(text)), ""),
                (text, "accent" if at == self.comparison.shown else "dim"),
            ]
            parts += [(" ", "")]
        left = f"  +{self.comparison.left_out}" if self.comparison.left_out else ""
        return (*parts, ("  node" if nodes else "", "dim"), (left, "dim"))

    def _columns(self, width: int) -> tuple[int, int, int]:
        """The cells of the name column, of each profile's column, and of the node column."""
        count = max(1, len(self.comparison.titles))
        longest = max((cell_len(self._label(each)) for each in self.comparison.rows), default=0) + 2
        names = min(max(longest, 12), max(NAME_CELLS, width - UNIT_CELLS - count * MIN_COLUMN))
        across = min(MAX_COLUMN, max(MIN_COLUMN, (width - names - UNIT_CELLS) // count))
        return names, across, NODE_CELLS if width - names - UNIT_CELLS - across * count >= NODE_CELLS else 0

    def _label(self, row: ComparedValue) -> str:
        name, first = sanitize(row.name), next(iter(row.nodes), "")
        if len(row.nodes) > 1:
            return f"{name} ×{len(row.nodes)}"
        return f"{name} {sanitize(first.rpartition('/')[2])}" if row.name in self._repeated else name

    def row(self, index: int, width: int) -> list[Segment]:
        """Name, unit, and for each profile its value, a bar and a mark."""
        row = self.rows[index]
        names, across, nodes = self._columns(width)
        dim = self.row_style("dim")
        parts = [
            Segment(cut(self._label(row), names - 1, pad=True) + " "),
            Segment(cut(sanitize(row.unit), UNIT_CELLS - 1, pad=True) + " ", dim),
        ]
        marks = {"⚠": self.row_style("warn"), "✗": self.row_style("error")}
        for at, cell in enumerate(row.cells):
            text = cut(sanitize(value_text(cell.value)), across - 5)
            chosen = self.row_style("strong") if at == self.comparison.shown else None
            style = marks.get(cell.mark, dim if cell.stays else chosen)
            parts += [
                Segment(" " * (across - 5 - cell_len(text)) + text + " ", style),
                Segment(cell.bar, dim if cell.stays else style),
                Segment(f" {cell.mark or ' '} ", marks.get(cell.mark)),
            ]
        return [*parts, Segment(f"  {sanitize(' '.join(row.nodes))}" if nodes else "", dim)]
