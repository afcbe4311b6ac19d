"""Namespaces that are worth folding: those with several members. Pure."""

from __future__ import annotations

from collections.abc import Iterable

MIN_MEMBERS = 2
"""Minimum number of names in a namespace that is worth folding."""


def foldable_namespaces(names: Iterable[str], above: str = "") -> frozenset[str]:
    """The namespaces directly below `above`, or below the root, with enough members to be folded.

    If a single namespace contains all the names, folding it would say nothing: the namespaces within it are returned.
    """
    below = [each for each in names if each.startswith(f"{above}/")]
    counts: dict[str, int] = {}
    for name in below:
        first, deeper, _ = name.removeprefix(f"{above}/").partition("/")
        if deeper:
            space = f"{above}/{first}"
            counts[space] = counts.get(space, 0) + 1
    found = frozenset(space for space, count in counts.items() if count >= MIN_MEMBERS)
    if len(found) == 1 and counts[space := next(iter(found))] == len(below):
        return foldable_namespaces(below, space) or found
    return found
