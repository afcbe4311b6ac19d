"""The view state of the tree survives as plain data."""

from __future__ import annotations

import pytest
from bot_console.tui.console.filter_syntax import parse
from bot_console.tui.panes.parameters.rows import View
from bot_console.tui.panes.parameters.view_state import ViewState, view_state_of


def test_view_state_survives_a_round_trip() -> None:
    left = ViewState(
        "nav speed", View(parse("nav speed"), True, False, frozenset({"/n", "/n:lidar"})), ("/n", "", "speed")
    )
    again = view_state_of(left.data)
    assert again is not None and again.data == left.data and again.at == left.at
    assert view_state_of(ViewState("", View()).data) == ViewState("", View())


@pytest.mark.parametrize("data", [None, 7, [], {"filter": "re:("}])
def test_invalid_data_yields_no_view_state(data: object) -> None:
    assert view_state_of(data) is None


def test_invalid_parts_are_ignored() -> None:
    assert view_state_of({"filter": 7, "closed": "x", "at": ["a"], "changed": "yes"}).view == View()
