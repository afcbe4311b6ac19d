"""The view state of the graph as plain data, kept for the next start. Pure."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, cast

from bot_console.tui.files.state_store import strings_in
from bot_console.tui.panes.graph.view import GraphView, Mode

STATE_NAME = "graph"
SWITCHES = ("debug", "dead_sinks", "leaves", "services")


@dataclass(frozen=True)
class ViewState:
    """The user's choices, without those that the pane makes automatically."""

    view: GraphView = field(default_factory=GraphView)
    folds: frozenset[str] | None = None
    rates: bool | None = None

    @property
    def data(self) -> dict[str, object]:
        """The choices as plain data."""
        return {
            **{each: getattr(self.view, each) for each in SWITCHES},
            "mode": self.view.mode.name,
            "folds": None if self.folds is None else sorted(self.folds),
            "rates": self.rates,
        }


def view_state_of(data: object) -> ViewState:
    """Restore the choices; parts that cannot be read get their defaults."""
    given = cast("Mapping[str, Any]", data) if isinstance(data, Mapping) else dict[str, Any]()
    switches = {each: given[each] for each in SWITCHES if isinstance(given.get(each), bool)}
    mode = next((each for each in Mode if each.name == given.get("mode")), Mode.FLOW)
    folds, rates = given.get("folds"), given.get("rates")
    known = frozenset(strings_in(cast("object", folds))) if isinstance(folds, list) else None
    return ViewState(replace(GraphView(), mode=mode, **switches), known, rates if isinstance(rates, bool) else None)
