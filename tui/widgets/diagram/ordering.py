"""Orders the items of each column so that few arrows cross. Pure."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

from bot_console.tui.widgets.diagram.columns import Layers

SWEEPS = 8

Key = tuple[str, int]
"""An item as (id, -1), or the place where the arrows of an item cross a column, as (id, column)."""

ITEM = -1


@dataclass(frozen=True)
class Columns:
    """The keys of each column from top to bottom, and the steps from each key to keys of the next column."""

    columns: tuple[tuple[Key, ...], ...]
    steps: Mapping[Key, tuple[Key, ...]]


def order_columns(layers: Layers) -> Columns:
    """Insert pass-through keys, then sort every column by the mean place of its neighbours, forwards and backwards."""
    count = max(layers.column.values(), default=-1) + 1
    columns: list[list[Key]] = [[] for _ in range(count)]
    for each, column in sorted(layers.column.items()):
        columns[column].append((each, ITEM))
    steps = _steps(layers, columns)
    before: dict[Key, list[Key]] = {}
    for source, targets in steps.items():
        for target in targets:
            before.setdefault(target, []).append(source)
    best, fewest = [list(each) for each in columns], _crossings(columns, steps)
    for sweep in range(SWEEPS):
        neighbours: Mapping[Key, Sequence[Key]] = before if sweep % 2 == 0 else steps
        for at in range(1, count) if sweep % 2 == 0 else range(count - 2, -1, -1):
            _sort(columns[at], columns[at - 1 if sweep % 2 == 0 else at + 1], neighbours)
        crossings = _crossings(columns, steps)
        if crossings < fewest:
            best, fewest = [list(each) for each in columns], crossings
    return Columns(tuple(tuple(each) for each in best), {key: tuple(each) for key, each in steps.items()})


def _steps(layers: Layers, columns: list[list[Key]]) -> dict[Key, list[Key]]:
    """Build one shared path for all arrows of each item, which splits as late as possible."""
    targets: dict[str, list[str]] = {}
    for a, b in layers.forward:
        targets.setdefault(a, []).append(b)
    steps: dict[Key, list[Key]] = {}
    for source, ends in targets.items():
        here: Key = (source, ITEM)
        last = max(layers.column[each] for each in ends)
        for column in range(layers.column[source] + 1, last + 1):
            steps[here] = [(each, ITEM) for each in ends if layers.column[each] == column]
            if column < last:
                crossing: Key = (source, column)
                columns[column].append(crossing)
                steps[here].append(crossing)
                here = crossing
    return steps


def _sort(column: list[Key], fixed: list[Key], neighbours: Mapping[Key, Sequence[Key]]) -> None:
    place = {key: at for at, key in enumerate(fixed)}
    own = {key: at for at, key in enumerate(column)}
    share = max(1, len(fixed)) / max(1, len(column))

    def middle(key: Key) -> float:
        places = [place[each] for each in neighbours.get(key, ()) if each in place]
        return sum(places) / len(places) if places else own[key] * share

    column.sort(key=lambda key: (middle(key), own[key]))


def _crossings(columns: Sequence[Sequence[Key]], steps: Mapping[Key, Sequence[Key]]) -> int:
    total = 0
    for left, right in pairwise(columns):
        place = {key: at for at, key in enumerate(right)}
        seen: list[int] = []
        for key in left:
            ends = sorted(place[each] for each in steps.get(key, ()) if each in place)
            total += sum(1 for end in ends for one in seen if one > end)
            seen += ends
    return total
