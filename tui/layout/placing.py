"""Computes the cells of each pane in a tree of splits. Pure."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from bot_console.tui.layout.tree import Split, SplitDirection, Tree

MIN_PANE_SIZE = (20, 4)
"""Columns and lines below which a pane shows nothing useful."""


class Box(NamedTuple):
    """A rectangle of cells: its upper left corner, its width and its height."""

    x: int
    y: int
    width: int
    height: int


@dataclass(frozen=True)
class Border:
    """The line between two parts of a split: which split (a path of part numbers), which line, and its position."""

    path: tuple[int, ...]
    after: int
    direction: SplitDirection
    box: Box
    """The two lines of cells on both sides of it."""
    whole: int
    """The columns, or lines, of the whole split."""


def boxes(tree: Tree, box: Box) -> dict[str, Box]:
    """The box of each pane."""
    if isinstance(tree, str):
        return {tree: box}
    found: dict[str, Box] = {}
    for part, own in zip(tree.parts, _parts(tree, box), strict=True):
        found |= boxes(part, own)
    return found


def borders(tree: Tree, box: Box, path: tuple[int, ...] = ()) -> Iterator[Border]:
    """The lines between parts, those of inner splits first."""
    if isinstance(tree, str):
        return
    places = _parts(tree, box)
    for at, (part, place) in enumerate(zip(tree.parts, places, strict=True)):
        yield from borders(part, place, (*path, at))
    for at, place in enumerate(places[1:]):
        if tree.direction == "beside":
            yield Border(path, at, tree.direction, Box(place.x - 1, box.y, 2, box.height), box.width)
        else:
            yield Border(path, at, tree.direction, Box(box.x, place.y - 1, box.width, 2), box.height)


def _parts(tree: Split, box: Box) -> list[Box]:
    """The boxes of the parts; the cells left over by rounding are spread evenly among them."""
    whole = box.width if tree.direction == "beside" else box.height
    total = sum(tree.shares)
    found: list[Box] = []
    begin = before = 0
    for share in tree.shares:
        before += share
        end = whole * before // total
        if tree.direction == "beside":
            found.append(Box(box.x + begin, box.y, end - begin, box.height))
        else:
            found.append(Box(box.x, box.y + begin, box.width, end - begin))
        begin = end
    return found


def fits(places: Mapping[str, Box]) -> bool:
    """Whether every pane has enough room to be usable."""
    return all(each.width >= MIN_PANE_SIZE[0] and each.height >= MIN_PANE_SIZE[1] for each in places.values())


def neighbour(places: Mapping[str, Box], pane: str, dx: int, dy: int) -> str:
    """The next pane in a direction; `pane` itself if there is none."""
    here = places[pane]
    others = [(name, box) for name, box in places.items() if name != pane and _is_in_direction(here, box, dx, dy)]
    return min(others, key=lambda each: _distance(here, each[1], dx, dy), default=(pane, here))[0]


def _is_in_direction(here: Box, there: Box, dx: int, dy: int) -> bool:
    if dx:
        return there.x >= here.x + here.width if dx > 0 else there.x + there.width <= here.x
    return there.y >= here.y + here.height if dy > 0 else there.y + there.height <= here.y


def _distance(here: Box, there: Box, dx: int, dy: int) -> tuple[int, int]:
    """The distance of a box in the direction, then how far its centre is to the side, as a key for sorting."""
    if dx:
        ahead = there.x - here.x - here.width if dx > 0 else here.x - there.x - there.width
        return ahead, _centre_offset((here.y, here.height), (there.y, there.height))
    ahead = there.y - here.y - here.height if dy > 0 else here.y - there.y - there.height
    return ahead, _centre_offset((here.x, here.width), (there.x, there.width))


def _centre_offset(one: Sequence[int], other: Sequence[int]) -> int:
    return abs(2 * one[0] + one[1] - 2 * other[0] - other[1])
