"""How many texts that were cut at a cell are kept.

Rich keeps the last 16,384 (letters that take other than one cell apart): braille of a robot that moves, and lines of a
log with an emoji, are hardly ever the same twice, and fill that within hours, up to 16 MB.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any, cast

from rich.segment import Segment

KEPT = 512
"""A few screens full."""


def keep_few_cuts() -> None:
    """Let Rich keep no more than `KEPT`; nothing is done where it keeps them in another way."""
    kept = cast(Any, vars(Segment).get("_split_cells"))
    cut = getattr(getattr(kept, "__func__", None), "__wrapped__", None)
    if cut is not None and kept.__func__.cache_parameters()["maxsize"] > KEPT:
        cast(Any, Segment)._split_cells = classmethod(lru_cache(KEPT)(cut))
