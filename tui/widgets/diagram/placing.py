"""Assigns items to rows: near the middle of their neighbours, in order, without touching. Pure.

Rows and columns are named for arrows that run to the right; for arrows that run down they are swapped.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from bot_console.tui.widgets.diagram.arrow_direction import ArrowDirection
from bot_console.tui.widgets.diagram.graph import Item
from bot_console.tui.widgets.diagram.ordering import ITEM, Columns, Key

SWEEPS = 7
STRAIGHT = 8.0
"""The weight of keeping the only arrow of an item straight."""

MAX_BEND_CELLS = 6
"""Maximum cells by which an item is moved to straighten an arrow."""


@dataclass
class Placement:
    """The first row and the height of each key; `middle` is the row of its outgoing arrow."""

    top: dict[Key, int] = field(default_factory=lambda: {})
    height: dict[Key, int] = field(default_factory=lambda: {})

    def middle(self, key: Key) -> int:
        """The row of an item's name and of its outgoing arrow."""
        return self.top[key] + (self.height[key] - 1) // 2

    @property
    def bottom(self) -> int:
        """The first row below everything."""
        return max((self.top[key] + self.height[key] for key in self.top), default=0)


def place_items(
    columns: Columns,
    items: Mapping[str, Item],
    arrows_in: Mapping[str, int],
    pushed: Mapping[Key, int],
    direction: ArrowDirection,
) -> Placement:
    """Assign rows; `arrows_in` is the number of arrows into an item, `pushed` adds free rows above a key."""
    result = Placement()
    for column in columns.columns:
        for key in column:
            across = direction.across(items[key[0]], arrows_in.get(key[0], 0)) if key[1] == ITEM else 1
            result.height[key] = across
    for column in columns.columns:
        row = 0
        for key in column:
            result.top[key] = row
            row += result.height[key] + direction.gap
    before: dict[Key, list[Key]] = {}
    for source, targets in columns.steps.items():
        for target in targets:
            before.setdefault(target, []).append(source)
    for sweep in range(SWEEPS):
        order = columns.columns if sweep % 2 == 0 else columns.columns[::-1]
        neighbours: Mapping[Key, Sequence[Key]] = before if sweep % 2 == 0 else columns.steps
        for column in order:
            _settle(column, neighbours, result, pushed, direction.gap)
    _straighten(columns.columns, before, result, direction.gap)
    highest = min(result.top.values(), default=0)
    result.top = {key: row - highest for key, row in result.top.items()}
    return result


def _settle(
    column: Sequence[Key],
    neighbours: Mapping[Key, Sequence[Key]],
    result: Placement,
    pushed: Mapping[Key, int],
    gap: int,
) -> None:
    wanted: list[float] = []
    offsets: list[int] = []
    weights: list[float] = []
    offset = 0
    for key in column:
        offset += pushed.get(key, 0)
        near = sorted(result.middle(each) for each in neighbours.get(key, ()))
        lift = (result.height[key] - 1) // 2
        row = near[len(near) // 2] - lift if near else result.top[key]
        wanted.append(row - offset)
        offsets.append(offset)
        weights.append(STRAIGHT if len(near) == 1 else 1.0)
        offset += result.height[key] + gap
    for key, row, below in zip(column, _monotone(wanted, weights), offsets, strict=True):
        result.top[key] = round(row) + below


def _straighten(
    columns: Sequence[Sequence[Key]], neighbours: Mapping[Key, Sequence[Key]], result: Placement, gap: int
) -> None:
    """Remove small bends: a key with a single neighbour moves to its row, if there is room."""
    for column in columns:
        for at, key in enumerate(column):
            near = neighbours.get(key, ())
            if len(near) != 1:
                continue
            top = result.top[key] + result.middle(near[0]) - result.middle(key)
            above = result.top[column[at - 1]] + result.height[column[at - 1]] + gap if at > 0 else top
            below = result.top[column[at + 1]] - gap - result.height[key] if at + 1 < len(column) else top
            if abs(top - result.top[key]) <= MAX_BEND_CELLS and above <= top <= below:
                result.top[key] = top


def _monotone(wanted: Sequence[float], weights: Sequence[float]) -> list[float]:
    """The non-decreasing sequence nearest to the wanted one (pooling adjacent violators)."""
    pools: list[tuple[float, float, int]] = []
    for each, heft in zip(wanted, weights, strict=True):
        mean, weight, count = each, heft, 1
        while pools and pools[-1][0] > mean:
            other, size, many = pools.pop()
            mean = (mean * weight + other * size) / (weight + size)
            weight += size
            count += many
        pools.append((mean, weight, count))
    return [mean for mean, _, count in pools for _ in range(count)]
