"""The view state of the parameter tree (folds, filter, cursor) as plain data, kept for the next start. Pure."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, cast

from bot_console.tui.console.filter_syntax import parse
from bot_console.tui.files.state_store import strings_in
from bot_console.tui.panes.parameters.rows import View

RowKey = tuple[str, str, str]
"""The key of a row: its node, its name in the tree, and the name of its parameter."""
MAX_FOLDS = 5000
"""Maximum number of folds kept."""
MAX_SPLIT = 500
"""Maximum cells by which the edge can have been moved."""


@dataclass(frozen=True)
class ViewState:
    """The state of the tree when the console was left: the filter, the view, and the row at the cursor."""

    words: str
    view: View
    at: RowKey | None = None
    split: int = 0
    """The number of cells by which the edge between names and values was moved."""

    @property
    def data(self) -> dict[str, object]:
        """The state as plain data, without defaults."""
        found: dict[str, object] = {"filter": self.words, "changed": self.view.only_changed}
        found |= {"split": self.split, "built_in": self.view.built_in, "closed": sorted(self.view.folded)[:MAX_FOLDS]}
        return {key: each for key, each in found.items() if each} | ({"at": list(self.at)} if self.at else {})


def view_state_of(data: object) -> ViewState | None:
    """Restore the state; None if `data` is no state, or its filter is no longer valid."""
    if not isinstance(data, Mapping):
        return None
    given = cast("Mapping[str, Any]", data)
    words, closed, at = given.get("filter", ""), given.get("closed", []), given.get("at", [])
    try:
        words = words if isinstance(words, str) else ""
        query = parse(words)
    except ValueError:
        return None
    folds = strings_in(closed)
    view = View(query, given.get("changed") is True, given.get("built_in") is True, frozenset(folds))
    row, split = strings_in(at), given.get("split")
    cells = split if isinstance(split, int) and abs(split) <= MAX_SPLIT else 0
    return ViewState(words, view, (row[0], row[1], row[2]) if len(row) == 3 else None, cells)
