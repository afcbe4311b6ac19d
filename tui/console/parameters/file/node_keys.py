"""Which nodes a key of a parameter file means, wildcards included, as ROS has it."""

from __future__ import annotations

import re
from functools import lru_cache


@lru_cache(maxsize=1000)
def _pattern(key: str) -> re.Pattern[str]:
    return re.compile(re.escape(key).replace(r"/\*\*", r"(?:/\w+)*").replace(r"/\*", r"/\w+"))


def means(key: str, node: str) -> bool:
    """Whether a key such as `/**`, `/*/lidar` or `/robot` means a node (fully qualified name)."""
    return _pattern(key).fullmatch(node) is not None


def is_wildcard(key: str) -> bool:
    """Whether a key may mean many nodes, so that not each of them need have what stands below it."""
    return "*" in key
