"""Every list has the same keys: first and last row, pages, filter, Escape, next and previous match."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

import pytest
from bot_console.tui.console.model import Kind, Severity
from bot_console.tui.panes.parameters.pane import ParametersPane
from bot_console.tui.panes.parameters.table import ParameterRows
from bot_console.tui.screens.picker import PickerScreen
from bot_console.tui.widgets.row_list import RowList
from fakes.console import FakeConsole
from fakes.launcher import FakeLauncher
from piloting import Session, run
from samples import live, with_array

LINES = 60
MATCH = "kiwi"


def crowded_system(elements: tuple[str, ...] = ()) -> tuple[FakeConsole, FakeLauncher]:
    """A system in which every list is longer than the screen, with three rows that match."""
    console, launcher = with_array(Kind.STRING_ARRAY, elements)
    for at in range(LINES):
        console.show_text(Severity.INFO, "/talker", f"{name(at)} {at}")
    tree = console.current.parameters["/robot_navigator"]
    first = tree.parameters[-1]
    many = tuple(replace(first, name=f"{name(at)}_{at:02}", description="") for at in range(LINES))
    info = console.current.launch
    process = info.processes[0]
    processes = tuple(replace(process, key=f"p{at}", label=f"{name(at)}-{at}") for at in range(LINES))
    profile = console.current.profiles[0]
    console.change(
        parameters={"/robot_navigator": replace(tree, parameters=(*tree.parameters, *many))},
        launch=replace(info, processes=processes),
        profiles=tuple(replace(profile, name=f"{name(at)}{at:02}", title="", path="") for at in range(LINES)),
    )
    launcher.known = tuple(f"/launch/{name(at)}{at:02}.launch.py" for at in range(LINES))
    return console, launcher


def name(at: int) -> str:
    return MATCH if at in (10, 30, 50) else "fruit"


LISTS = {"parameters": "1", "logs": "2", "profiles": "7", "launch": "8"}
each_list = pytest.mark.parametrize(
    "digit",
    [pytest.param(digit, id=pane, marks=() if pane == "logs" else pytest.mark.slow) for pane, digit in LISTS.items()],
)
"""All are lists of the same kind: the default run tries one of them."""


def focused(session: Session) -> RowList:
    rows = session.app.focused
    assert isinstance(rows, RowList)
    return rows


def at_cursor(rows: RowList) -> str:
    """The text that identifies the row at the cursor, whatever the widths of its columns."""
    return identifying_text("".join(each.text for each in rows.row(rows.cursor, 200)))


def identifying_text(text: str) -> str:
    found = re.search(rf"{MATCH}[\d _-]*\d", text)
    return found[0] if found else text


async def check_ends_and_pages(session: Session, rows: RowList, home: str, end: str) -> None:
    await session.press(end)
    last = rows.row_count() - 1
    assert rows.cursor == last > 20
    assert 0 <= last - rows.scroll_offset.y < rows.size.height, "the cursor is in view"
    await session.press(home)
    assert rows.cursor == rows.scroll_offset.y == 0
    await session.press("pagedown")
    assert rows.cursor == rows.size.height - 1
    await session.press("pageup")
    assert rows.cursor == 0


@each_list
def test_keys_go_to_first_and_last_row_and_by_pages(digit: str) -> None:
    async def play(session: Session) -> None:
        await session.press(digit)
        for home, end in (("g", "G"), ("home", "end")):
            await check_ends_and_pages(session, focused(session), home, end)

    run(crowded_system(), play)


def matches(rows: RowList) -> Sequence[str]:
    texts = ("".join(each.text for each in rows.row(index, 200)) for index in range(rows.row_count()))
    return [identifying_text(text) for text in texts if MATCH in text]


async def filter_and_step(session: Session) -> None:
    rows = focused(session)
    every = rows.row_count()
    await session.press("slash", *MATCH, "enter")
    assert len(matches(rows)) == 3 and rows.row_count() < every
    assert " 3 of " in session.text() and f"/{MATCH}" in session.text()
    assert MATCH in at_cursor(rows)
    here = at_cursor(rows)
    await session.press("n")
    assert MATCH in at_cursor(rows) != here
    await session.press("N")
    assert at_cursor(rows) == here
    await session.press("escape")
    assert rows.row_count() == every and at_cursor(rows) == here, "the cursor stays on its item"
    seen = []
    for _ in range(3):
        await session.press("n")
        seen.append(at_cursor(rows))
    assert sorted(seen) == sorted(matches(rows)) and seen[-1] == here
    await session.press("N")
    assert at_cursor(rows) == seen[1]


@each_list
def test_filter_counts_matches_and_n_steps_through_them(digit: str) -> None:
    async def play(session: Session) -> None:
        await session.press(digit)
        await filter_and_step(session)

    run(crowded_system(), play, size=(120, 40))


@pytest.mark.parametrize("digits", ["2", pytest.param("31278", marks=pytest.mark.slow)])
def test_next_match_without_search_or_matches_is_reported_in_each_pane(digits: str) -> None:
    async def play(session: Session) -> None:
        for digit in digits:
            session.app.clear_notifications()
            await session.press(digit)
            assert "Nothing was" not in session.text() and "Nothing here" not in session.text()
            await session.press("n")
            assert "There is no search yet" in session.text()
            await session.press("slash", *"zzz", "enter", "escape", "n")
            assert "Nothing here matches zzz" in session.text()

    run(live(), play, size=(120, 40))


def test_next_match_works_in_the_graph() -> None:
    async def play(session: Session) -> None:
        await session.press("3", "slash")
        await session.paste("scan")
        await session.press("enter", "escape", "n")
        from bot_console.tui.widgets.diagram_view import DiagramView

        first = session.pane(DiagramView).selected
        assert first == "line:/sensor_handler>/robot_navigator"
        assert "/sensor_handler → /robot_navigator  /scan" in session.text(), "a line matches by the topics on it"
        await session.press("n")
        assert "/scan" in session.text() and session.pane(DiagramView).selected not in ("", first)

    run(live(), play, size=(120, 40))


@pytest.mark.slow
def test_search_in_elements_hides_nothing() -> None:
    async def play(session: Session) -> None:
        await session.press("1", "slash", *"a_list", "enter", "enter")
        rows = focused(session)
        await check_ends_and_pages(session, rows, "g", "G")
        await session.press("slash", *MATCH, "enter")
        assert rows.row_count() == LINES and rows.cursor == 10
        await session.press("n", "n")
        assert rows.cursor == 50
        await session.press("N")
        assert rows.cursor == 30

    run(crowded_system(tuple(f"{name(at)}_{at}" for at in range(LINES))), play)


def test_picker_has_the_same_keys_for_ends_and_pages() -> None:
    async def play(session: Session) -> None:
        await session.press("8", "o")
        assert isinstance(session.app.screen, PickerScreen)
        rows = session.app.screen.query_one(RowList)
        await check_ends_and_pages(session, rows, "home", "end")
        await session.type(MATCH)
        assert rows.row_count() == 3 and "3 of " in session.text()

    run(crowded_system(), play)


def test_pane_keys_are_disabled_while_typing() -> None:
    async def play(session: Session) -> None:
        await session.press("4", "a", "up", "escape", "down")
        before = session.text()
        await session.press("a", "up", "escape")
        assert session.text() == before
        await session.press("up")
        assert session.text() != before, "up chooses another curve while nothing is typed"

    run(live(), play)


def test_row_ellipsis_is_visible_beside_the_scroll_bar() -> None:
    async def play(session: Session) -> None:
        await session.press("1")
        rows = session.pane(ParametersPane).query_one(ParameterRows)
        session.pane(ParametersPane).action_toggle_built_in()
        await session.settle()
        assert rows.show_vertical_scrollbar
        assert {rows.render_line(y).cell_length for y in range(rows.size.height)} == {rows.size.width - 1}

    run(live(), play, (60, 20))
