"""How much is kept of what was drawn, and looked for, before.

Rich keeps the last 16,384 texts that it cut at a cell (letters that take other than one cell apart): braille of a robot
that moves, and lines of a log with an emoji, are hardly ever the same twice, and fill that within hours, up to 16 MB.
Textual keeps the last 1,024 answers to `query_one` of each widget, none of which holds once a widget has come or gone,
or another pane is shown.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any, cast

from rich.segment import Segment
from textual.dom import DOMNode

CUTS = 512
"""A few screens full."""
ANSWERS = 32
"""More than a pane or a screen looks for between two changes."""


def keep_few_cuts() -> None:
    """Let Rich keep no more than `CUTS`; nothing is done where it keeps them in another way."""
    kept = cast(Any, vars(Segment).get("_split_cells"))
    cut = getattr(getattr(kept, "__func__", None), "__wrapped__", None)
    if cut is not None and kept.__func__.cache_parameters()["maxsize"] > CUTS:
        cast(Any, Segment)._split_cells = classmethod(lru_cache(CUTS)(cut))


def keep_few_answers(node: DOMNode) -> None:
    """Let a widget keep no more than `ANSWERS`, to be called before it is asked; likewise."""
    answers = getattr(node, "_query_one_cache", None)
    if answers is not None:
        answers.maxsize = ANSWERS
