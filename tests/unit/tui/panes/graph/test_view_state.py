"""The saved view of the graph: plain data, with defaults for parts that cannot be read."""

from __future__ import annotations

import pytest
from bot_console.tui.panes.graph.view import GraphView, Mode
from bot_console.tui.panes.graph.view_state import ViewState, view_state_of


def test_view_state_survives_a_round_trip() -> None:
    left = ViewState(GraphView(mode=Mode.NODES, debug=True, leaves=False), frozenset({"/arm"}), rates=True)
    assert view_state_of(left.data) == left


@pytest.mark.parametrize(
    "data", [None, "x", {"mode": "nope", "debug": "yes", "folds": 3, "rates": 1}, ViewState().data]
)
def test_invalid_parts_get_their_defaults(data: object) -> None:
    assert view_state_of(data) == ViewState()
