"""An array is changed element by element, and set as a whole when the person says so."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from types import MappingProxyType

import pytest
from bot_console.tui.console.model import Kind, Value
from bot_console.tui.panes.parameters.pane import ParametersPane
from bot_console.tui.panes.parameters.table import ParameterRows
from bot_console.tui.screens.array_editor import ElementRows, ElementsScreen
from piloting import Session, run
from samples import with_array


async def open_array(session: Session) -> None:
    await session.press("1", "home")
    rows = session.pane(ParametersPane).query_one(ParameterRows)
    at = next(index for index, row in enumerate(rows.rows) if row.name == "a_list")
    rows.cursor = at
    await session.press("enter")
    assert isinstance(session.app.screen, ElementsScreen)


def sets(session: Session) -> list[Value]:
    return [each[2]["a_list"] for each in session.console.asked if each[0] == "set"]


def edit_array(kind: Kind, value: Value, play: Callable[[Session], Awaitable[None]]) -> list[Value]:
    """Open the list of an array, press keys, and return the values that were set."""
    found: list[Value] = []

    async def scene(session: Session) -> None:
        await open_array(session)
        await play(session)
        found.extend(sets(session))

    run(with_array(kind, value), scene)
    return found


def test_array_is_edited_element_by_element_and_set_once() -> None:
    async def play(session: Session) -> None:
        await session.press("enter")
        await session.type("9")
        await session.press("enter", "a")  # 9 | new | 2 3
        await session.type("7.5")
        await session.press("enter", "down", "d", "J")  # 9 7.5 3, then 3 is the last: it stays
        await session.press("K", "s")  # 9 3 7.5

    assert edit_array(Kind.DOUBLE_ARRAY, (1.0, 2.0, 3.0), play) == [(9.0, 3.0, 7.5)]


def test_an_element_may_be_an_expression_as_the_value_of_a_number() -> None:
    async def play(session: Session) -> None:
        await session.press("enter")
        await session.type("9/4")
        await session.press("enter", "s")

    assert edit_array(Kind.DOUBLE_ARRAY, (1.0, 2.0), play) == [(2.25, 2.0)]


@pytest.mark.slow
def test_a_text_with_a_comma_stays_one_element() -> None:
    async def play(session: Session) -> None:
        assert "b, d" in session.text()
        await session.press("down", "i")
        await session.type("x, y")
        await session.press("enter", "s")

    assert edit_array(Kind.STRING_ARRAY, ("a", "b, d"), play) == [("a", "x, y", "b, d")]


def test_search_goes_to_matching_elements_and_hides_none() -> None:
    async def play(session: Session) -> None:
        rows = session.app.screen.query_one(ElementRows)
        await session.press("slash")
        await session.paste("kiwi")
        await session.press("enter")
        assert rows.row_count() == 4 and rows.cursor == 1
        await session.press("n")
        assert rows.cursor == 3

    assert edit_array(Kind.STRING_ARRAY, ("fig", "kiwi", "plum", "kiwi 2"), play) == []


def test_invalid_element_is_explained_and_rejected() -> None:
    async def play(session: Session) -> None:
        await session.press("enter")
        await session.type("x")
        await session.press("enter")
        assert "is not an integer" in session.text()
        await session.press("escape", "s")

    assert edit_array(Kind.INTEGER_ARRAY, (1,), play) == []


@pytest.mark.slow
def test_byte_array_and_empty_array_are_edited() -> None:
    async def play(session: Session) -> None:
        assert "empty" in session.text()
        assert "s Set" in session.text() and "u Undo" in session.text(), "the keys fit 80 columns"
        await session.press("enter")
        assert "new [0] (byte)" in session.text()
        await session.type("x")
        await session.press("enter")
        assert "not a byte: 0x00 .. 0xff" in session.text()
        await session.press("backspace")
        await session.type("255")
        await session.press("enter")
        assert "0xff" in session.text()
        await session.press("s")

    assert edit_array(Kind.BYTE_ARRAY, (), play) == [(b"\xff",)]


@pytest.mark.parametrize("undone", [pytest.param(True, marks=pytest.mark.slow), False])
def test_changes_are_discarded_only_at_the_second_escape(undone: bool) -> None:
    async def play(session: Session) -> None:
        await session.press("d", *(["u"] if undone else []), "escape")
        assert isinstance(session.app.screen, ElementsScreen) is not undone
        if not undone:
            assert "s sets it" in session.text()
            await session.press("escape")
        assert not isinstance(session.app.screen, ElementsScreen)

    assert edit_array(Kind.BOOL_ARRAY, (True, False), play) == []


def test_the_list_closes_when_the_node_leaves() -> None:
    async def play(session: Session) -> None:
        session.console.change(parameters=MappingProxyType({}))
        session.app.pull()
        await session.pilot.pause()
        assert not isinstance(session.app.screen, ElementsScreen)
        assert "has left" in session.text()

    assert edit_array(Kind.BOOL_ARRAY, (True, False), play) == []
