"""Trees of splits as plain data, the form of a layout file."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any, cast

from bot_console.tui.layout.tree import Split, Tree, panes

MAX_DEPTH = 8


class LayoutError(ValueError):
    """The data do not describe a layout; the message says what is wrong and what is expected."""


def tree_to_data(tree: Tree) -> object:
    """A tree as names, lists and mappings: `{beside: [parameters, {below: [world, plot]}], share: [3, 2]}`."""
    if isinstance(tree, str):
        return tree
    data: dict[str, object] = {tree.direction: [tree_to_data(part) for part in tree.parts]}
    if len(set(tree.shares)) > 1:
        data["share"] = list(tree.shares)
    return data


def tree_from_data(data: object, known: Collection[str]) -> Tree:
    """The tree that data describe; raises `LayoutError`."""
    tree = _tree(data, known, 0)
    twice = sorted({pane for pane in panes(tree) if panes(tree).count(pane) > 1})
    if twice:
        raise LayoutError(f"{twice[0]} is listed twice; a pane can be shown only once")
    return tree


def _tree(data: object, known: Collection[str], depth: int) -> Tree:
    if isinstance(data, str):
        if data not in known:
            raise LayoutError(f"there is no pane '{data[:40]}'; panes: {', '.join(sorted(known))}")
        return data
    if depth > MAX_DEPTH:
        raise LayoutError(f"splits are nested deeper than {MAX_DEPTH}")
    if not isinstance(data, Mapping):
        raise LayoutError(f"a pane's name, or a mapping with 'beside' or 'below', not {_kind(data)}")
    given = cast("Mapping[object, Any]", data)
    unknown = [str(key) for key in given if key not in ("beside", "below", "share")]
    directions = [direction for direction in ("beside", "below") if direction in given]
    if unknown or len(directions) != 1:
        raise LayoutError(f"'{unknown[0][:40]}' is not known here" if unknown else "give either 'beside' or 'below'")
    parts = given[directions[0]]
    if not isinstance(parts, list) or len(cast("list[object]", parts)) < 2:
        raise LayoutError(f"'{directions[0]}' has a list of two parts or more")
    trees = tuple(_tree(part, known, depth + 1) for part in cast("list[object]", parts))
    return Split("beside" if directions[0] == "beside" else "below", trees, _shares(given.get("share"), len(trees)))


def _shares(given: object, count: int) -> tuple[int, ...]:
    if given is None:
        return (1,) * count
    shares = cast("list[object]", given) if isinstance(given, list) else []
    whole = [each for each in shares if isinstance(each, int) and not isinstance(each, bool) and 0 < each <= 10_000]
    if len(whole) != count or len(shares) != count:
        raise LayoutError(f"'share' has a positive whole number for each of the {count} parts")
    return tuple(whole)


def _kind(data: object) -> str:
    return "nothing" if data is None else f"a {type(data).__name__}"
