"""Matches the keys of a parameter file with nodes, as ROS does, including wildcards."""

from __future__ import annotations

import re
from functools import lru_cache


@lru_cache(maxsize=1000)
def _pattern(key: str) -> re.Pattern[str]:
    return re.compile(re.escape(key).replace(r"/\*\*", r"(?:/\w+)*").replace(r"/\*", r"/\w+"))


def matches_node(key: str, node: str) -> bool:
    """Whether a key such as `/**`, `/*/lidar` or `/robot` applies to a node (fully qualified name)."""
    return _pattern(key).fullmatch(node) is not None


def is_wildcard(key: str) -> bool:
    """Whether a key may apply to many nodes, not all of which need to have the parameters below it."""
    return "*" in key
