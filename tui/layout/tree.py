"""The tree of splits: which panes are beside and below one another, and how they share the room. Pure.

A tree is a pane, by its id, or a `Split`. A pane occurs in a tree at most once.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import gcd
from typing import Literal, TypeAlias

SplitDirection: TypeAlias = Literal["beside", "below"]

MIN_SHARE = 0.05
"""The minimum share of a part, however much it is shrunk."""


@dataclass(frozen=True)
class Split:
    """Parts from left to right (`beside`) or from top to bottom (`below`), with a share of the room for each."""

    direction: SplitDirection
    parts: tuple[Tree, ...]
    shares: tuple[int, ...]

    def __post_init__(self) -> None:
        if len(self.parts) < 2 or len(self.parts) != len(self.shares) or min(self.shares) < 1:
            raise ValueError("a split has two parts or more, and a positive share for each")


Tree: TypeAlias = "str | Split"


def beside(*parts: Tree, shares: Sequence[int] = ()) -> Split:
    """Parts from left to right; without shares all are equally wide."""
    return Split("beside", parts, tuple(shares) or (1,) * len(parts))


def below(*parts: Tree, shares: Sequence[int] = ()) -> Split:
    """Parts from top to bottom; without shares all are equally high."""
    return Split("below", parts, tuple(shares) or (1,) * len(parts))


def panes(tree: Tree) -> tuple[str, ...]:
    """The panes of a tree, from the upper left."""
    return (tree,) if isinstance(tree, str) else tuple(pane for part in tree.parts for pane in panes(part))


def split(tree: Tree, pane: str, new: str, direction: SplitDirection) -> Tree:
    """Put a pane beside or below another one, which gives it half of its room; if the tree has the pane already, it
    moves.
    """
    rest = close(tree, new) if new in panes(tree) and new != pane else tree
    return tree if rest is None or new == pane else _split(rest, pane, new, direction)


def _split(tree: Tree, pane: str, new: str, direction: SplitDirection) -> Tree:
    if isinstance(tree, str):
        return Split(direction, (tree, new), (1, 1)) if tree == pane else tree
    if tree.direction == direction and pane in tree.parts:
        at = tree.parts.index(pane)
        shares = [2 * each for each in tree.shares]
        shares[at : at + 1] = [tree.shares[at]] * 2
        return Split(direction, (*tree.parts[: at + 1], new, *tree.parts[at + 1 :]), _reduced(shares))
    return _each(tree, lambda part: _split(part, pane, new, direction))


def close(tree: Tree, pane: str) -> Tree | None:
    """Remove a pane; its neighbours take its room. None if nothing is left."""
    if isinstance(tree, str):
        return None if tree == pane else tree
    closed = [(close(part, pane), share) for part, share in zip(tree.parts, tree.shares, strict=True)]
    kept = [(part, share) for part, share in closed if part is not None]
    if not kept:
        return None
    if len(kept) == 1:
        return kept[0][0]
    return _merged(tree.direction, kept)


def exchange(tree: Tree, one: str, other: str) -> Tree:
    """Swap two panes; a pane that is not in the tree replaces the other."""
    names = {one: other, other: one}
    return _named(tree, lambda pane: names.get(pane, pane))


def resize(tree: Tree, pane: str, direction: SplitDirection, part: float) -> Tree:
    """Widen (`beside`) or heighten (`below`) a pane within the innermost such split, by a fraction of that split.

    Its neighbour loses what it gains, down to a small minimum. A pane in no such split keeps its size.
    """
    if isinstance(tree, str) or pane not in panes(tree):
        return tree
    at = next(index for index, each in enumerate(tree.parts) if pane in panes(each))
    inner = resize(tree.parts[at], pane, direction, part)
    if inner != tree.parts[at] or tree.direction != direction:
        return Split(tree.direction, (*tree.parts[:at], inner, *tree.parts[at + 1 :]), tree.shares)
    return move_border(tree, at if at + 1 < len(tree.parts) else at - 1, part if at + 1 < len(tree.parts) else -part)


def move_border(tree: Split, border: int, part: float) -> Split:
    """Move the border after a part of a split, by a fraction of the whole: one side gains what the other loses."""
    whole = sum(tree.shares)
    first, second = (tree.shares[at] / whole for at in (border, border + 1))
    least = min(MIN_SHARE, first, second)
    grown = min(max(first + part, least), first + second - least)
    shares = [round(1000 * each / whole) for each in tree.shares]
    both = round(1000 * (first + second))
    shares[border] = min(max(round(1000 * grown), 1), both - 1)
    shares[border + 1] = both - shares[border]
    return Split(tree.direction, tree.parts, _reduced([max(1, each) for each in shares]))


def change_at(tree: Tree, path: Sequence[int], change: Callable[[Split], Tree]) -> Tree:
    """Change the split at a path of part numbers; raises `LookupError` if there is none."""
    if isinstance(tree, str):
        raise LookupError("there is no split")
    if not path:
        return change(tree)
    at = path[0]
    return Split(
        tree.direction,
        (*tree.parts[:at], change_at(tree.parts[at], path[1:], change), *tree.parts[at + 1 :]),
        tree.shares,
    )


def even(tree: Tree) -> Tree:
    """Share all room equally."""
    return (
        tree if isinstance(tree, str) else Split(tree.direction, tuple(map(even, tree.parts)), (1,) * len(tree.parts))
    )


def turn(tree: Tree, pane: str) -> Tree:
    """Turn the innermost split that contains a pane: beside becomes below, or the reverse."""
    if isinstance(tree, str):
        return tree
    if pane in tree.parts:
        return Split("below" if tree.direction == "beside" else "beside", tree.parts, tree.shares)
    return _each(tree, lambda part: turn(part, pane))


def _each(tree: Split, change: Callable[[Tree], Tree]) -> Split:
    return Split(tree.direction, tuple(map(change, tree.parts)), tree.shares)


def _named(tree: Tree, name: Callable[[str], str]) -> Tree:
    return name(tree) if isinstance(tree, str) else _each(tree, lambda part: _named(part, name))


def _merged(direction: SplitDirection, kept: Sequence[tuple[Tree, int]]) -> Split:
    """The split with nested splits of its own direction flattened, which looks the same."""
    scale = 1
    for part, _ in kept:
        if isinstance(part, Split) and part.direction == direction:
            scale *= sum(part.shares)
    parts: list[Tree] = []
    shares: list[int] = []
    for part, share in kept:
        if isinstance(part, Split) and part.direction == direction:
            parts += part.parts
            shares += [share * scale * each // sum(part.shares) for each in part.shares]
        else:
            parts.append(part)
            shares.append(share * scale)
    return Split(direction, tuple(parts), _reduced(shares))


def _reduced(shares: Sequence[int]) -> tuple[int, ...]:
    common = gcd(*shares)
    return tuple(each // common for each in shares)
