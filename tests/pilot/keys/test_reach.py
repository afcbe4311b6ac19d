"""Every pane can be reached and left by keys alone, and the global keys work in each."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import pytest
from bot_console.tui.keymap import TABLE
from bot_console.tui.keys.key import key_text
from bot_console.tui.pane_table import PANES
from bot_console.tui.panes.launch.pane import LaunchPane
from bot_console.tui.panes.logs.pane import LogsPane
from bot_console.tui.panes.pane import Pane
from bot_console.tui.panes.parameters.pane import ParameterRows, ParametersPane
from bot_console.tui.panes.parameters.rows import BUILT_IN
from bot_console.tui.panes.profiles.pane import ProfilesPane
from bot_console.tui.screens.picker import PickerScreen
from bot_console.tui.widgets.row_list import RowList
from piloting import Session, run
from samples import live
from textual.widgets import Input

IDS = [each.id for each in PANES]


def visible_pane_ids(session: Session) -> list[str]:
    return [each.id or "" for each in session.app.visible_panes()]


@dataclass
class PaneVisit:
    """The state of the console after the key of a pane was pressed."""

    shown: list[str]
    current: str | None
    has_focus: bool
    key_bar: str
    claims: dict[str, set[str]]
    """Every key that a scope around the focus claims, with the ids of its actions."""
    first_stop: object
    status: str
    second_stop: object


@cache
def visits() -> dict[str, PaneVisit]:
    """Walk once through all panes; several tests examine the keys found there."""
    found: dict[str, PaneVisit] = {}

    async def play(session: Session) -> None:
        for entry in PANES:
            await session.press(entry.key)
            pane, key_bar = session.app.current_pane, session.lines()[-1]
            at, seen, held = session.app.focused, visible_pane_ids(session), claims(session)
            await session.press("exclamation_mark")
            first, status = session.console.asked[-1], session.lines()[-2]
            await session.press("exclamation_mark")
            second = session.console.asked[-1]
            found[entry.id] = PaneVisit(seen, pane and pane.id, at is not None, key_bar, held, first, status, second)

    run(live(), play, (60, 20))
    return found


def claims(session: Session) -> dict[str, set[str]]:
    ours = {key.id for keys in TABLE.values() for key in keys}
    found: dict[str, set[str]] = {}
    for node in session.app.focused.ancestors_with_self if session.app.focused else ():
        for key, bound in node._bindings.key_to_bindings.items():
            found.setdefault(key, set()).update(each.id for each in bound if each.id in ours)
    return found


def test_digit_opens_and_focuses_the_pane() -> None:
    assert [*visits()] == IDS
    for id, visit in visits().items():
        assert visit.shown == [id] and visit.current == id and visit.has_focus, id


def test_tab_and_shift_tab_open_the_next_pane_and_the_one_before() -> None:
    async def play(session: Session) -> None:
        await session.press("1", "tab")
        following = session.app.current_pane.id
        assert following in IDS[1:] and visible_pane_ids(session) == [following]
        await session.press("shift+tab")
        assert session.app.current_pane.id == "parameters"
        await session.press("shift+tab")
        assert session.app.current_pane.id not in ("parameters", following), "before the first comes the last"

    run(live(), play)


@pytest.mark.slow
def test_tab_cycles_through_panes_and_shift_tab_back() -> None:
    async def play(session: Session) -> None:
        await session.press("1")
        seen = [session.app.current_pane.id]
        for _ in IDS[1:]:
            await session.press("tab")
            seen.append(session.app.current_pane.id)
        assert sorted(seen) == sorted(IDS)
        await session.press("tab")
        assert session.app.current_pane.id == "parameters"
        await session.press("shift+tab")
        assert session.app.current_pane.id == seen[-1]

    run(live(), play)


@pytest.mark.slow
def test_overview_shows_the_panes_that_fit() -> None:
    fitting = {
        (60, 20): {"parameters", "world", "logs"},
        (80, 24): {"parameters", "world", "plot", "logs"},
        (120, 40): {"parameters", "world", "plot", "logs"},
        (200, 60): {"parameters", "world", "plot", "logs", "graph"},
    }

    async def play(session: Session) -> None:
        for size, expected in fitting.items():
            await session.press("4")
            await session.pilot.resize_terminal(*size)
            await session.press("0")
            assert set(visible_pane_ids(session)) == expected, size

    run(live(), play)


def test_z_maximises_a_pane_and_restores_the_overview() -> None:
    async def play(session: Session) -> None:
        await session.press("tab", "z")
        assert visible_pane_ids(session) == ["world"]
        await session.press("z")
        assert len(visible_pane_ids(session)) == 4

    run(live(), play, (120, 40))


def test_too_small_terminal_shows_a_message_and_recovers() -> None:
    async def play(session: Session) -> None:
        await session.pilot.resize_terminal(50, 15)
        await session.settle()
        assert "50x15 is too small" in session.text() and "60x20" in session.text()
        await session.press("exclamation_mark")
        await session.press("exclamation_mark")
        stops = [each for each in session.console.asked if each[0] == "all_stop"]
        assert stops == [("all_stop", True)] * 2, "it releases no stop that cannot be seen"
        assert "goes on" not in session.text()
        await session.pilot.resize_terminal(80, 24)
        await session.settle()
        assert "too small" not in session.text() and "max_speed" in session.text()

    run(live(), play)


def test_tiny_terminal_still_names_the_stop_and_quit_keys() -> None:
    async def play(session: Session) -> None:
        await session.pilot.resize_terminal(20, 5)
        await session.settle()
        for words in ("20x5 is too small", "60x20", "! stops the robot", "q quits"):
            assert words in session.text()
        await session.pilot.resize_terminal(1, 1)
        await session.settle()
        assert session.app.is_running

    run(live(), play)


@pytest.mark.parametrize("ids", [IDS[:1], pytest.param(IDS[1:], marks=pytest.mark.slow)], ids=["first", "others"])
def test_help_names_every_key_of_the_pane(ids: list[str]) -> None:
    async def play(session: Session) -> None:
        for entry in (each for each in PANES if each.id in ids):
            await session.press(entry.key, "question_mark")
            seen = session.text()
            for key in TABLE[entry.id]:
                assert key.text in seen, (entry.id, key.id)
                assert key_text(key) in seen, (entry.id, key.id)
            await session.press("escape")
            assert len(session.app.screen_stack) == 1

    run(live(), play, (100, 70))


def test_long_help_scrolls() -> None:
    async def play(session: Session) -> None:
        await session.press("1", "question_mark")
        begin = session.text()
        await session.press("pagedown")
        assert session.text() != begin
        await session.press("home")
        assert session.text() == begin

    run(live(), play)


@pytest.mark.slow
@pytest.mark.parametrize("key", ["ctrl+p"])
def test_palette_runs_an_action(key: str) -> None:
    async def play(session: Session) -> None:
        await session.press(key)
        assert isinstance(session.app.screen, PickerScreen)
        await session.type("world")
        await session.press("enter")
        assert visible_pane_ids(session) == ["world"]

    run(live(), play)


def test_the_palette_shows_the_pane_of_an_action_and_runs_it() -> None:
    async def play(session: Session) -> None:
        await session.press("1", "ctrl+p")
        await session.type("load parameters")
        await session.press("enter")
        await session.settle()
        assert visible_pane_ids(session) == ["profiles"]
        assert isinstance(session.app.screen, PickerScreen) or "parameter file" in session.text().lower()
        assert not [each for each in session.console.asked if each[0] != "watch"]

    run(live(), play)


def test_the_all_stop_works_in_every_pane() -> None:
    for id, visit in visits().items():
        assert visit.first_stop == ("all_stop", True) and "ALL STOP" in visit.status, id
        assert visit.second_stop == ("all_stop", False), id


@pytest.mark.parametrize("ids", [IDS[:1], pytest.param(IDS[1:], marks=pytest.mark.slow)], ids=["first", "others"])
def test_the_all_stop_works_over_the_help_of_every_pane(ids: list[str]) -> None:
    async def play(session: Session) -> None:
        for entry in (each for each in PANES if each.id in ids):
            await session.press(entry.key, "exclamation_mark")
            assert session.console.asked[-1] == ("all_stop", True), entry.id
            await session.press("question_mark", "exclamation_mark", "escape")
            assert session.console.asked[-1] == ("all_stop", False), entry.id

    run(live(), play)


@pytest.mark.slow
def test_in_a_text_field_the_all_stop_and_digits_are_text() -> None:
    async def play(session: Session) -> None:
        await session.press("2", "slash")
        await session.type("!5z")
        field = session.app.focused
        assert isinstance(field, Input) and field.value == "!5z"
        assert not [each for each in session.console.asked if each[0] == "all_stop"]
        assert visible_pane_ids(session) == ["logs"]

    run(live(), play)


def test_key_bar_names_help_and_stop_at_the_minimum_width() -> None:
    for id, visit in visits().items():
        assert "? Help" in visit.key_bar and "! Stop" in visit.key_bar, id


def test_q_quits() -> None:
    async def play(session: Session) -> None:
        await session.press("q")
        assert not session.app.is_running or session.app._exit

    run(live(), play, (60, 20))


def test_no_two_scopes_that_are_live_together_claim_one_key() -> None:
    for id, visit in visits().items():
        assert {key for key in visit.claims if key in ("q", "0")} == {"q", "0"}, "the keys of the app are among them"
        assert {key: ids for key, ids in visit.claims.items() if len(ids) > 1} == {}, id


@pytest.mark.slow
def test_the_key_bar_names_the_filter_at_80_columns() -> None:
    async def play(session: Session) -> None:
        for digit in ("1", "2", "3"):
            await session.press(digit)
            assert "/ Filter" in session.lines()[-1], digit

    run(live(), play)


@pytest.mark.slow
def test_every_list_has_keys_for_first_and_last_row() -> None:
    panes: tuple[type[Pane], ...] = (ParametersPane, LaunchPane, ProfilesPane, LogsPane)

    async def play(session: Session) -> None:
        for pane in panes:
            await session.press(next(each.key for each in PANES if each.load() is pane))
            rows = next(each for each in session.pane(pane).query(RowList) if each.can_focus)
            for last, first in (("G", "g"), ("end", "home")):
                await session.press(last)
                assert rows.cursor == rows.row_count() - 1 > 0, pane
                await session.press(first)
                assert rows.cursor == 0, pane

    run(live(), play)


def test_first_cursor_is_on_the_most_important_parameter_in_any_node_order() -> None:
    system = live()
    trees = dict(system[0].current.parameters)
    system[0].change(parameters={"/simulator": trees["/simulator"]})

    async def play(session: Session) -> None:
        await session.press("1")
        session.console.change(parameters=dict(sorted(trees.items())))
        await session.settle()
        rows = session.pane(ParameterRows)
        assert rows.current is not None and rows.current.name == "max_speed"
        await session.press("home", "slash")
        await session.type("max")
        await session.press("enter")
        every = sum(each.name not in BUILT_IN for tree in trees.values() for each in tree.parameters)
        shown = sum(row.parameter is not None for row in rows.rows)
        assert 0 < shown < every
        assert f"/max  {shown} of {every}" in session.text()
        await session.press("escape")
        assert "/max" not in session.text()

    run(system, play)


@pytest.mark.parametrize(("lines", "released"), [(20, False), (24, True)])
def test_stop_key_releases_no_stop_whose_line_the_help_covers(lines: int, *, released: bool) -> None:
    async def play(session: Session) -> None:
        await session.press("exclamation_mark")
        await session.press("question_mark")
        await session.press("exclamation_mark")
        assert session.console.asked[-1] == ("all_stop", not released)

    run(live(), play, (60, lines))
