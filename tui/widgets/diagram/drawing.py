"""Lays out and draws a graph as rows of runs, each a piece of text with the item or edges it shows. Pure."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple, overload

from bot_console.tui.widgets.diagram.arrow_direction import RIGHT, ArrowDirection
from bot_console.tui.widgets.diagram.columns import Edge, Layers, layers
from bot_console.tui.widgets.diagram.graph import Digraph, Item
from bot_console.tui.widgets.diagram.lines import Lines
from bot_console.tui.widgets.diagram.ordering import ITEM, Columns, Key, order_columns
from bot_console.tui.widgets.diagram.placing import Placement, place_items
from bot_console.tui.widgets.diagram.routing import Channel, Trunk, channel
from rich.cells import cell_len

MAX_ATTEMPTS = 6


class Run(NamedTuple):
    """A segment of a row: its column, its text, and the item it belongs to or the edges it draws."""

    x: int
    text: str
    item: str = ""
    edges: frozenset[Edge] = frozenset()


@dataclass(frozen=True)
class Place:
    """The position of an item in cells; `boxed` says whether it has a frame."""

    x: int
    y: int
    width: int
    height: int
    boxed: bool


@dataclass(frozen=True)
class Drawing:
    """A drawn graph: rows of runs from left to right, without overlap, and the place of each item."""

    rows: Sequence[tuple[Run, ...]] = ()
    places: Mapping[str, Place] | None = None
    width: int = 0
    edges: tuple[Edge, ...] = ()

    def text(self) -> str:
        """The picture as plain text."""
        lines: list[str] = []
        for row in self.rows:
            line = ""
            for run in row:
                line += " " * (run.x - cell_len(line)) + run.text
            lines.append(line.rstrip())
        return "\n".join(lines)


def draw(graph: Digraph, direction: ArrowDirection = RIGHT) -> Drawing:
    """Lay a graph out and draw it."""
    if not graph.items:
        return Drawing((), {})
    items = {item.id: item for item in graph.items}
    found = layers(graph)
    columns = order_columns(found)
    arrows_in: dict[str, int] = {}
    for _, b in (*found.forward, *found.back):
        arrows_in[b] = arrows_in.get(b, 0) + 1
    pushed: dict[Key, int] = {}
    plan = _Plan(items, found, columns, place_items(columns, items, arrows_in, pushed, direction), direction)
    for _ in range(MAX_ATTEMPTS):
        blocked = {key for each in plan.channels for key in each.blocked}
        if not blocked:
            break
        # Where two arrows would share a row, one of the items moves a row down.
        for key in blocked:
            pushed[key] = pushed.get(key, 0) + 1
        plan = _Plan(items, found, columns, place_items(columns, items, arrows_in, pushed, direction), direction)
    return plan.picture()


class _Plan:
    """The rows, ports, tracks and lanes of one attempt."""

    def __init__(
        self, items: Mapping[str, Item], found: Layers, columns: Columns, at: Placement, direction: ArrowDirection
    ) -> None:
        self.items = items
        self.found = found
        self.columns = columns
        self.at = at
        self.direction = direction
        self.back: dict[str, list[str]] = {}
        for a, b in found.back:
            self.back.setdefault(a, []).append(b)
        self.lanes = self._lanes()
        self.ports = self._ports()
        self.trunks = [self._trunks(each) for each in range(-1, len(columns.columns))]
        self.channels: list[Channel] = [channel(each) for each in self.trunks]

    def _lanes(self) -> dict[str, int]:
        """The row below the picture for each item's backward edges; short ones run inside long ones."""
        column = self.found.column
        spans = {a: (min(column[b] for b in ends), column[a] + 1) for a, ends in self.back.items()}
        lanes: list[list[tuple[int, int]]] = []
        rows: dict[str, int] = {}
        for owner, (begin, end) in sorted(spans.items(), key=lambda each: (each[1][1] - each[1][0], each)):
            fit = next((at for at, lane in enumerate(lanes) if all(end < b or e < begin for b, e in lane)), len(lanes))
            if fit == len(lanes):
                lanes.append([])
            lanes[fit].append((begin, end))
            rows[owner] = self.at.bottom + 1 + fit * self.direction.lane
        return rows

    def _ports(self) -> dict[Edge, int]:
        """The row on which each edge ends, from top to bottom in the order in which the arrows arrive."""
        coming: dict[str, list[tuple[float, str]]] = {}
        for key, targets in self.columns.steps.items():
            for target in (each for each in targets if each[1] == ITEM):
                coming.setdefault(target[0], []).append((self.at.middle(key), key[0]))
        for a, b in self.found.back:
            coming.setdefault(b, []).append((self.lanes[a], a))
        ports: dict[Edge, int] = {}
        for target, sources in coming.items():
            key = (target, ITEM)
            first = self.direction.first_port(self.at.top[key], self.at.height[key], len(sources))
            for row, (_, source) in enumerate(sorted(sources)):
                ports[source, target] = first + row * self.direction.port
        return ports

    def _trunks(self, column: int) -> list[Trunk]:
        """The trunks in the channel right of a column; -1 is the one left of everything."""
        trunks: list[Trunk] = []
        here = self.columns.columns[column] if column >= 0 else ()
        seen: set[str] = set()
        for key in here:
            ends = [(self._row_of(key[0], each), each) for each in self.columns.steps.get(key, ())]
            returns = self._returns(key[0], column + 1)
            down = self.lanes[key[0]] if key[1] == ITEM and key[0] in self.back else None
            if ends or down is not None:
                seen.add(key[0])
                lane = down if down is not None else (self.lanes[key[0]] if returns else None)
                trunks.append(Trunk(key[0], self.at.middle(key), tuple(ends + returns), lane))
        for owner in sorted(set(self.back) - seen):
            returns = self._returns(owner, column + 1)
            if returns:
                trunks.append(Trunk(owner, None, tuple(returns), self.lanes[owner]))
        return trunks

    def _row_of(self, owner: str, target: Key) -> int:
        return self.ports[owner, target[0]] if target[1] == ITEM else self.at.middle(target)

    def _returns(self, owner: str, column: int) -> list[tuple[int, Key]]:
        ends = (each for each in self.back.get(owner, ()) if self.found.column[each] == column)
        return [(self.ports[owner, each], (each, ITEM)) for each in ends]

    def picture(self) -> Drawing:
        """Draw everything."""
        widths = [self._width(column) for column in self.columns.columns]
        lines = Lines(self.direction.downward)
        x = 0
        left: list[int] = []
        for at, here in enumerate(self.channels):
            first = x
            outermost = at in (0, len(self.channels) - 1)
            room = 0 if outermost and not self.trunks[at] else self.direction.room(here.tracks)
            x += room
            left.append(x)
            for trunk in self.trunks[at]:
                vertical = first + 1 + self.direction.track * here.track.get(trunk.owner, 0)
                self._draw_trunk(lines, trunk, first, vertical, x, at - 1, widths)
            x += widths[at] if at < len(widths) else 0
        places = self._places(left, widths)
        boxes = _boxes(places, self.items)
        edge = max([self.at.bottom, *(row + 1 for row in self.lanes.values())])
        width, height = (edge, x) if self.direction.downward else (x, edge)
        return Drawing(Rows(height, lines, boxes), places, width, (*self.found.forward, *self.found.back))

    def _width(self, column: Iterable[Key]) -> int:
        labels = (self.items[each] for each, kind in column if kind == ITEM)
        return max((self.direction.along(item) for item in labels), default=1)

    def _draw_trunk(
        self, lines: Lines, trunk: Trunk, first: int, vertical: int, end: int, column: int, widths: list[int]
    ) -> None:
        edges = {(trunk.owner, key[0]) for _, key in trunk.leaves if key[1] == ITEM}
        through = any(key[1] != ITEM for _, key in trunk.leaves)
        later = self._later(trunk.owner, column + 1) if through else set[Edge]()
        returns = self.back.get(trunk.owner, ()) if trunk.down is not None else ()
        backward = {(trunk.owner, each) for each in returns}
        everything = frozenset(edges | later | backward)
        straight = trunk.straight
        if trunk.enters is not None:
            start = first - self._gap(trunk.owner, column, widths)
            lines.across(trunk.enters, start, end - 1 if straight else vertical, everything)
        later_edges = frozenset(later)
        leaves = [
            (row, key, frozenset({(trunk.owner, key[0])}) if key[1] == ITEM else later_edges)
            for row, key in trunk.leaves
        ]
        origin = trunk.enters if trunk.enters is not None else trunk.down
        if not straight and origin is not None:
            lines.branches(vertical, origin, [(row, own) for row, _, own in leaves])
        for row, key, own in leaves:
            if not straight:
                lines.across(row, vertical, end - 1, own)
            if key[1] == ITEM:
                lines.arrow(end - 1, row, own)
            else:
                lines.across(row, end - 1, end + widths[column + 1] - 1, own)
        if trunk.down is not None:
            self._draw_lane(lines, trunk, vertical, frozenset(backward))

    def _later(self, owner: str, column: int) -> set[Edge]:
        return {each for each in self.found.forward if each[0] == owner and self.found.column[each[1]] > column}

    def _gap(self, owner: str, column: int, widths: list[int]) -> int:
        """The cells between an item and the right end of its column."""
        item = self.items[owner]
        if column < 0 or self.found.column[owner] != column:
            return 0
        return widths[column] - self.direction.along(item)

    def _draw_lane(self, lines: Lines, trunk: Trunk, vertical: int, edges: frozenset[Edge]) -> None:
        if trunk.down is None:
            return
        if trunk.enters is not None and self._is_source(trunk):
            lines.down(vertical, trunk.enters, trunk.down, edges)
        lines.lane(trunk.owner, trunk.down, vertical, edges)

    def _is_source(self, trunk: Trunk) -> bool:
        return trunk.owner in self.back

    def _places(self, left: list[int], widths: list[int]) -> dict[str, Place]:
        places: dict[str, Place] = {}
        for at, column in enumerate(self.columns.columns):
            for each, kind in column:
                if kind == ITEM:
                    item = self.items[each]
                    key = (each, ITEM)
                    along, across = self.direction.along(item), self.at.height[key]
                    places[each] = (
                        Place(self.at.top[key], left[at], across, along, item.boxed)
                        if self.direction.downward
                        else Place(left[at], self.at.top[key], along, across, item.boxed)
                    )
        return places


def _boxes(places: Mapping[str, Place], items: Mapping[str, Item]) -> dict[int, list[Run]]:
    rows: dict[int, list[Run]] = {}
    for each, place in places.items():
        label = items[each].label
        middle = (place.height - 1) // 2
        for row in range(place.height):
            if not place.boxed:
                text = _centred(label, place.width) if row == middle else " " * place.width
            elif row in (0, place.height - 1):
                ends = "╭╮" if row == 0 else "╰╯"
                text = ends[0] + "─" * (place.width - 2) + ends[1]
            else:
                text = f"│{_centred(label if row == middle else '', place.width - 2)}│"
            rows.setdefault(place.y + row, []).append(Run(place.x, text, each))
    return rows


def _centred(text: str, width: int) -> str:
    free = width - cell_len(text)
    return " " * (free // 2) + text + " " * (free - free // 2)


class Rows(Sequence[tuple[Run, ...]]):
    """Rows that are assembled on access, as only a few rows of a large picture are ever shown."""

    def __init__(self, count: int, lines: Lines, boxes: Mapping[int, list[Run]]) -> None:
        self._count = count
        self._lines = lines
        self._boxes = boxes
        self._made: dict[int, tuple[Run, ...]] = {}

    def __len__(self) -> int:
        return self._count

    @overload
    def __getitem__(self, index: int, /) -> tuple[Run, ...]: ...

    @overload
    def __getitem__(self, index: slice, /) -> list[tuple[Run, ...]]: ...

    def __getitem__(self, index: int | slice, /) -> tuple[Run, ...] | list[tuple[Run, ...]]:
        if isinstance(index, slice):
            return [self[each] for each in range(*index.indices(self._count))]
        if not -self._count <= index < self._count:
            raise IndexError(index)
        y = index % self._count
        if y not in self._made:
            runs = [*self._boxes.get(y, ()), *(Run(x, text, "", edges) for x, text, edges in self._lines.row(y))]
            self._made[y] = tuple(sorted(runs, key=lambda run: run.x))
        return self._made[y]
