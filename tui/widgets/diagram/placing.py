"""On which rows the items stand: near the middle of their neighbours, in order, without touching. Pure."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from bot_console.tui.widgets.diagram.graph import Item
from bot_console.tui.widgets.diagram.ordering import ITEM, Columns, Key

SWEEPS = 6


@dataclass
class Placed:
    """The first row and the height of each key; `middle` is the row where its arrow leaves."""

    top: dict[Key, int] = field(default_factory=lambda: {})
    height: dict[Key, int] = field(default_factory=lambda: {})

    def middle(self, key: Key) -> int:
        """The row on which an item's name stands and its arrow leaves."""
        return self.top[key] + (self.height[key] - 1) // 2

    @property
    def bottom(self) -> int:
        """The first row below everything."""
        return max((self.top[key] + self.height[key] for key in self.top), default=0)


def placed(
    columns: Columns, items: Mapping[str, Item], arrows_in: Mapping[str, int], pushed: Mapping[Key, int]
) -> Placed:
    """Rows for everything; `arrows_in` is how many arrows end at an item, `pushed` adds free rows above a key."""
    result = Placed()
    for column in columns.columns:
        for key in column:
            inside = max(1, arrows_in.get(key[0], 1)) if key[1] == ITEM else 1
            result.height[key] = inside + 2 if key[1] == ITEM and items[key[0]].boxed else inside
    for column in columns.columns:
        row = 0
        for key in column:
            result.top[key] = row
            row += result.height[key] + 1
    before: dict[Key, list[Key]] = {}
    for source, targets in columns.steps.items():
        for target in targets:
            before.setdefault(target, []).append(source)
    for sweep in range(SWEEPS):
        order = columns.columns if sweep % 2 == 0 else columns.columns[::-1]
        neighbours: Mapping[Key, Sequence[Key]] = before if sweep % 2 == 0 else columns.steps
        for column in order:
            _settle(column, neighbours, result, pushed)
    highest = min(result.top.values(), default=0)
    result.top = {key: row - highest for key, row in result.top.items()}
    return result


def _settle(
    column: Sequence[Key], neighbours: Mapping[Key, Sequence[Key]], result: Placed, pushed: Mapping[Key, int]
) -> None:
    wanted: list[float] = []
    offsets: list[int] = []
    offset = 0
    for key in column:
        offset += pushed.get(key, 0)
        near = sorted(result.middle(each) for each in neighbours.get(key, ()))
        lift = (result.height[key] - 1) // 2
        row = near[len(near) // 2] - lift if near else result.top[key]
        wanted.append(row - offset)
        offsets.append(offset)
        offset += result.height[key] + 1
    for key, row, below in zip(column, _monotone(wanted), offsets, strict=True):
        result.top[key] = round(row) + below


def _monotone(wanted: Sequence[float]) -> list[float]:
    """The non-decreasing sequence nearest to what is wanted (pooling neighbours that want to overtake)."""
    pools: list[tuple[float, int]] = []
    for each in wanted:
        mean, count = each, 1
        while pools and pools[-1][0] > mean:
            other, size = pools.pop()
            mean = (mean * count + other * size) / (count + size)
            count += size
        pools.append((mean, count))
    return [mean for mean, count in pools for _ in range(count)]
