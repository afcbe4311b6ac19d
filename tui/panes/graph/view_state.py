"""The view state of the graph as plain data, kept for the next start. Pure."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, cast

from bot_console.tui.panes.graph.view import GraphView, Mode

KEPT = "graph"
SWITCHES = ("debug", "dead_sinks", "leaves", "services")


@dataclass(frozen=True)
class ViewState:
    """The user's choices, without those that the pane makes by itself."""

    mode: Mode | None = None
    view: GraphView = field(default_factory=GraphView)
    folds: frozenset[str] | None = None
    rates: bool = False

    @property
    def data(self) -> dict[str, object]:
        """As plain data."""
        return {
            **{each: getattr(self.view, each) for each in SWITCHES},
            "mode": self.mode.name if self.mode else "",
            "folds": None if self.folds is None else sorted(self.folds),
            "rates": self.rates,
        }


def view_state_of(data: object) -> ViewState:
    """Restore the choices; parts that cannot be read get their defaults."""
    given = cast("Mapping[str, Any]", data) if isinstance(data, Mapping) else dict[str, Any]()
    switches = {each: given[each] for each in SWITCHES if isinstance(given.get(each), bool)}
    mode = next((each for each in Mode if each.name == given.get("mode")), None)
    folds = given.get("folds")
    known = frozenset(map(str, cast("list[object]", folds))) if isinstance(folds, list) else None
    return ViewState(mode, replace(GraphView(), **switches), known, given.get("rates") is True)
