"""Finds units in the descriptions of parameters. Standard library only."""

from __future__ import annotations

import re
from functools import lru_cache

_DIMENSIONLESS = re.compile(r"\b(factor|fraction|probability|ratio|share)\b", re.IGNORECASE)


@lru_cache(maxsize=20_000)
def unit_in_description(description: str) -> str:
    """The unit in brackets at the end of a description, `(m/s)` or `[m/s]`; empty if there is none."""
    text = description.rstrip()
    start = text.rfind({")": "(", "]": "["}.get(text[-1:], "\0"))
    inside = text[start + 1 : -1].split()[-1:] if start >= 0 else []
    return inside[0] if inside and any(character.isalpha() for character in inside[0]) and len(inside[0]) <= 6 else ""


def is_dimensionless(description: str) -> bool:
    """Whether a description calls the value a ratio, a share or the like, which has no unit."""
    return _DIMENSIONLESS.search(description) is not None
