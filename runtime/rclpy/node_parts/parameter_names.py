"""Selects parameter names by prefix and depth."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, cast

from rclpy.parameter import PARAMETER_SEPARATOR_STRING

ANY_DEPTH = 0


def listed(names: Iterable[str], prefixes: Any, depth: Any) -> list[str]:
    """The names that `list_parameters` returns, in their order; raises `TypeError` and `ValueError`."""
    if not isinstance(prefixes, list):
        raise TypeError("The prefixes argument must be a list")
    wanted = cast("list[Any]", prefixes)
    if not all(isinstance(prefix, str) for prefix in wanted):
        raise TypeError("All prefixes must be instances of type str")
    if not isinstance(depth, int):
        raise TypeError("The depth must be instance of type int")
    if depth < 0:
        raise ValueError("The depth must be greater than or equal to zero")
    if not prefixes:
        return [name for name in names if _shallow(name, depth)]
    return [name for name in names if any(_below(name, prefix, depth) for prefix in wanted)]


def _shallow(name: str, depth: int) -> bool:
    return depth == ANY_DEPTH or name.count(PARAMETER_SEPARATOR_STRING) < depth


def _below(name: str, prefix: str, depth: int) -> bool:
    start = prefix + PARAMETER_SEPARATOR_STRING
    return name == prefix or (name.startswith(start) and _shallow(name[len(start) :], depth))
