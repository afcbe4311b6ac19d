"""The view state of the parameter tree (open, filtered, selected) as plain data for the next start. Pure."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, cast

from bot_console.tui.console.query import parse
from bot_console.tui.files.state_store import texts_in
from bot_console.tui.panes.parameters.rows import View

At = tuple[str, str, str]
"""A row: its node, its name in the tree, its parameter."""
MAX_FOLDS = 5000
"""Folds that are kept."""
MAX_SPLIT = 500
"""Cells by which an edge can have been moved."""


@dataclass(frozen=True)
class Left:
    """The filter's words, the view that they belong to, and the row at the cursor."""

    words: str
    view: View
    at: At | None = None
    split: int = 0
    """By how many cells the edge between names and values was moved."""

    @property
    def data(self) -> dict[str, object]:
        """As plain data; what is as in a first run is left out."""
        found: dict[str, object] = {"filter": self.words, "changed": self.view.only_changed}
        found |= {"split": self.split, "built_in": self.view.built_in, "closed": sorted(self.view.folded)[:MAX_FOLDS]}
        return {key: each for key, each in found.items() if each} | ({"at": list(self.at)} if self.at else {})


def left_of(data: object) -> Left | None:
    """How it was left; None where that is not known, or where its filter is none any more."""
    if not isinstance(data, Mapping):
        return None
    given = cast("Mapping[str, Any]", data)
    words, closed, at = given.get("filter", ""), given.get("closed", []), given.get("at", [])
    try:
        words = words if isinstance(words, str) else ""
        query = parse(words)
    except ValueError:
        return None
    folds = texts_in(closed)
    view = View(query, given.get("changed") is True, given.get("built_in") is True, frozenset(folds))
    row, split = texts_in(at), given.get("split")
    cells = split if isinstance(split, int) and abs(split) <= MAX_SPLIT else 0
    return Left(words, view, (row[0], row[1], row[2]) if len(row) == 3 else None, cells)
