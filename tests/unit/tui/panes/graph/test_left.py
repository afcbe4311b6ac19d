"""How the graph's picture is left: kept as plain data, and what cannot be read is the default."""

from __future__ import annotations

import pytest
from bot_console.tui.panes.graph.left import Left, left_of
from bot_console.tui.panes.graph.view import GraphView, Mode


def test_it_is_read_as_it_was_kept() -> None:
    left = Left(Mode.NODES, GraphView(debug=True, leaves=False), frozenset({"/arm"}), rates=True)
    assert left_of(left.data) == left


@pytest.mark.parametrize("data", [None, "x", {"mode": "nope", "debug": "yes", "folds": 3, "rates": 1}, Left().data])
def test_what_cannot_be_read_is_as_at_first(data: object) -> None:
    assert left_of(data) == Left()
