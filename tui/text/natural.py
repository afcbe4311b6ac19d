"""The order of names in which numbers count as numbers: robot2 before robot10. Pure."""

from __future__ import annotations

import re
from functools import lru_cache
from typing import TypeAlias

NaturalKey: TypeAlias = "tuple[tuple[tuple[bool, int, str], ...], str]"
_PIECE = re.compile(r"[0-9]+|[^0-9]")


@lru_cache(maxsize=20_000)
def natural_key(name: str) -> NaturalKey:
    """The sort key of a name: numbers by their value and before other characters, everything else as in plain order."""
    return tuple(_piece(each) for each in _PIECE.findall(name)), name


def _piece(text: str) -> tuple[bool, int, str]:
    """The key of a piece; numbers are compared as digits, by length first, since one may be too long to convert."""
    digits = text.lstrip("0")
    return (False, len(digits), digits) if text[0] in "0123456789" else (True, 0, text)
