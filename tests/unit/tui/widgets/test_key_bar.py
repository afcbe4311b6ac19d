"""Which keys the key bar names if there is no room for all."""

from __future__ import annotations

import pytest
from bot_console.tui.keymap import TABLE
from bot_console.tui.keys.key import Key
from bot_console.tui.pane_table import PANES
from bot_console.tui.widgets.key_bar import BarKey, bar_keys, fitting_keys

WIDE, NARROW = 200, 78


def words(keys: list[BarKey]) -> list[str]:
    return [each.word for each in keys]


def keys_of(*scopes: str) -> list[BarKey]:
    return [each for scope in (*scopes, "app") for each in bar_keys(TABLE.get(scope, ()), {})]


def test_all_keys_are_named_where_there_is_room() -> None:
    keys = keys_of("parameters", "find")
    assert fitting_keys([], keys, WIDE) == keys


@pytest.mark.parametrize(
    ("scopes", "expected"),
    [
        (("parameters", "find"), ("Edit", "More", "Less", "Undo", "Filter")),
        (("logs", "find"), ("Follow", "Message", "Search", "Filter")),
        (("launch",), ("Open", "Start", "Stop", "Restart", "Kill", "Details")),
        (("steering",), ("Arm", "Faster", "Slower", "Left", "Right")),
        (("graph", "find"), ("Details", "Mode", "Frames", "Filter")),
    ],
)
def test_keys_of_a_pane_come_before_those_that_work_everywhere(
    scopes: tuple[str, ...], expected: tuple[str, ...]
) -> None:
    found = words(fitting_keys([], keys_of(*scopes), NARROW))
    assert set(expected) <= set(found)


@pytest.mark.parametrize("columns", [8, 20, 58, 78, 98])
@pytest.mark.parametrize("pane", [each.id for each in PANES])
def test_stop_is_always_named(pane: str, columns: int) -> None:
    assert "app.stop" in [each.id for each in fitting_keys([], keys_of(pane, "find"), columns)]


def test_keys_of_a_mode_come_first_and_are_left_out_last() -> None:
    mode = [BarKey("a", "Apply 3", "a", "parameters.apply"), BarKey("A", "Send as set B", "A", "parameters.compare")]
    found = fitting_keys(mode, keys_of("parameters", "find"), NARROW)
    assert found[:2] == mode
    assert words(fitting_keys(mode, keys_of("parameters", "find"), 34)) == ["Apply 3", "Send as set B", "Stop"]


def test_no_key_is_named_without_a_word() -> None:
    assert [*bar_keys([Key("a.b", "x", "do", "What it does", footer="Do")], {"a.b": ""})] == []
