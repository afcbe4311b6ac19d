"""Limits on Rich's and Textual's caches.

Rich caches the last 16,384 texts that it cut at a cell (if they contain characters wider or narrower than one): braille
of a moving robot, and log lines with an emoji, are hardly ever the same twice and fill that within hours, up to 16 MB.
Textual caches the last 1,024 answers to `query_one` in each widget, none of which holds after the next change of its
children.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any, cast

from rich.segment import Segment
from textual.dom import DOMNode

MAX_CUTS = 512
"""Maximum number of cached cuts: enough for a few screens."""
MAX_ANSWERS = 32
"""Maximum number of cached answers: more than a pane or a screen asks for between two changes."""


def limit_cut_cache() -> None:
    """Limit Rich's cache of split segments to `MAX_CUTS` entries; does nothing if Rich caches them differently."""
    kept = cast(Any, vars(Segment).get("_split_cells"))
    cut = getattr(getattr(kept, "__func__", None), "__wrapped__", None)
    if cut is not None and kept.__func__.cache_parameters()["maxsize"] > MAX_CUTS:
        cast(Any, Segment)._split_cells = classmethod(lru_cache(MAX_CUTS)(cut))


def limit_query_cache(node: DOMNode) -> None:
    """Limit a widget's query cache to `MAX_ANSWERS` entries, before its first query; does nothing if there is none."""
    answers = getattr(node, "_query_one_cache", None)
    if answers is not None:
        answers.maxsize = MAX_ANSWERS
