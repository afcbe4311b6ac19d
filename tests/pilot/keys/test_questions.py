"""Questions belong to the item that they are about: they close when it disappears, and keep up with fast typing."""

from __future__ import annotations

from dataclasses import replace
from types import MappingProxyType

import pytest
from bot_console.tui.panes.launch.pane import LaunchPane
from bot_console.tui.panes.logs.rows import LogRows
from bot_console.tui.panes.parameters.pane import ParametersPane
from bot_console.tui.panes.parameters.table import ParameterRows
from bot_console.tui.screens.confirm import ConfirmScreen
from bot_console.tui.screens.picker import PickerScreen
from bot_console.tui.widgets.prompt.line import Prompt
from piloting import Session, run
from samples import live
from textual import events
from textual.keys import _character_to_key
from textual.widgets import Input


def rows(session: Session) -> ParameterRows:
    return session.pane(ParametersPane).query_one(ParameterRows)


def set_requests(session: Session) -> list[tuple[object, ...]]:
    return [each[1:] for each in session.console.asked if each[0] == "set"]


def prompt(session: Session) -> Prompt:
    return session.pane(ParametersPane).query_one(Prompt)


async def at_once(session: Session, text: str) -> None:
    """Type without waiting in between, as a fast person or a busy machine does."""
    for character in text:
        special = {"\r": "enter", "\x1b": "escape", "\x10": "ctrl+p"}.get(character)
        key = special or _character_to_key(character)
        session.app.post_message(events.Key(key, None if special else character))
    for _ in range(3):
        await session.settle()


async def edit(session: Session, name: str) -> None:
    await session.press("1")
    found = rows(session)
    found.cursor = next(i for i, row in enumerate(found.rows) if row.parameter and row.parameter.name == name)
    await session.press("e")
    assert prompt(session).is_open


def remove_node(session: Session, node: str) -> None:
    trees = session.console.current.parameters
    session.console.change(parameters=MappingProxyType({name: tree for name, tree in trees.items() if name != node}))


def test_value_is_set_on_the_edited_parameter_after_the_cursor_moved() -> None:
    async def play(session: Session) -> None:
        assert not session.app.screen.query(Input), "fields are made when they are first used"
        await edit(session, "max_speed")
        rows(session).cursor += 2
        await session.type("2")
        await session.press("enter")
        assert set_requests(session) == [("/robot_navigator", {"max_speed": 2.0})]

    run(live(), play)


def test_key_bar_names_the_keys_of_the_focused_widget() -> None:
    async def play(session: Session) -> None:
        await edit(session, "max_speed")
        assert "esc Cancel" in session.lines()[-1] and "e Edit" not in session.lines()[-1]
        await session.press("escape")
        assert "esc Cancel" not in session.lines()[-1] and "/ Filter" in session.lines()[-1]

    run(live(), play)


def test_click_moves_cursor_and_prompt_keeps_focus() -> None:
    async def play(session: Session) -> None:
        await edit(session, "max_speed")
        at = rows(session).cursor
        await session.pilot.click(ParameterRows, offset=(20, at + 2))
        assert rows(session).cursor == at + 2
        await session.type("2")
        await session.press("enter")
        assert set_requests(session) == [("/robot_navigator", {"max_speed": 2.0})]
        assert session.app.focused is rows(session)

    run(live(), play)


def test_click_into_another_pane_closes_the_prompt() -> None:
    async def play(session: Session) -> None:
        await edit(session, "max_speed")
        await session.press("escape", "0", "e")
        assert prompt(session).is_open
        await session.pilot.click(LogRows, offset=(20, 1))
        assert not prompt(session).is_open and session.app.focused is not rows(session)
        await session.pilot.click(ParameterRows, offset=(20, 3))
        await session.press("e")
        assert prompt(session).is_open

    run(live(), play, (120, 40))


@pytest.mark.parametrize("gone", [pytest.param("node", marks=pytest.mark.slow), "parameter"])
def test_edit_closes_when_its_node_leaves(gone: str) -> None:
    async def play(session: Session) -> None:
        await edit(session, "max_speed")
        if gone == "node":
            remove_node(session, "/robot_navigator")
        else:
            trees = dict(session.console.current.parameters)
            tree = trees["/robot_navigator"]
            left = tuple(each for each in tree.parameters if each.name != "max_speed")
            trees["/robot_navigator"] = replace(tree, parameters=left)
            session.console.change(parameters=MappingProxyType(trees))
        await session.settle()
        assert not prompt(session).is_open and "was not set" in session.text().replace("\n", " ")
        assert session.app.focused is rows(session)
        await session.press("enter")
        assert set_requests(session) == []

    run(live(), play, (120, 30))


def test_answer_is_refused_if_the_node_has_just_left() -> None:
    async def play(session: Session) -> None:
        await edit(session, "max_speed")
        remove_node(session, "/robot_navigator")
        await at_once(session, "2\r")
        assert set_requests(session) == [] and not prompt(session).is_open

    run(live(), play)


def test_kill_confirmation_closes_when_the_process_has_ended() -> None:
    async def play(session: Session) -> None:
        await session.press("8", "down", "down", "K")
        assert isinstance(session.app.screen, ConfirmScreen)
        launch = session.console.current.launch
        session.console.change(launch=replace(launch, processes=()))
        session.app.pull()
        await session.settle()
        assert len(session.app.screen_stack) == 1
        assert "ended in the meantime" in session.text()
        assert session.launcher.asked == []

    run(live(), play, (120, 30))


def test_characters_typed_after_the_filter_key_belong_to_the_filter() -> None:
    async def play(session: Session) -> None:
        await session.press("2")
        await at_once(session, "/quit 1 z! done\r")
        assert "/quit 1 z! done" in session.text()
        assert session.app.return_code is None and not session.console.current.drive.stopped

    run(live(), play)


@pytest.mark.slow
def test_keys_typed_fast_go_to_the_value_until_enter() -> None:
    async def play(session: Session) -> None:
        await edit(session, "max_speed")
        await session.press("escape")
        await at_once(session, "e2.5\rj")
        assert set_requests(session) == [("/robot_navigator", {"max_speed": 2.5})]
        assert rows(session).current.name != "max_speed"

    run(live(), play)


@pytest.mark.slow
def test_characters_typed_after_the_palette_key_belong_to_the_palette() -> None:
    async def play(session: Session) -> None:
        await at_once(session, "\x10node graph")
        assert isinstance(session.app.screen, PickerScreen) and "node graph" in session.text()
        await at_once(session, "\r")
        assert [each.id for each in session.app.visible_panes()] == ["graph"]
        await at_once(session, ":ros2 node list\r")
        assert "/robot_navigator" in session.text() and ("run", "ros2 node list") in session.console.asked

    run(live(), play)


@pytest.mark.parametrize(
    "typed",
    [
        (":\x1b\x1b", "8o\x1b\x1b\x1b"),
        pytest.param((":\r\r", ":xyzzy\r\r", ":?\r\x1b\r", "8o\r\r", "?qq"), marks=pytest.mark.slow),
    ],
    ids=["escape", "others"],
)
def test_escape_pressed_twice_closes_one_prompt_at_a_time(typed: tuple[str, ...]) -> None:
    async def play(session: Session) -> None:
        for keys in typed:
            await session.press("escape", "escape", "escape")
            await at_once(session, keys)
            assert session.app._exception is None, keys
            assert session.app.screen_stack, keys

    run(live(), play)


@pytest.mark.parametrize(
    "typed",
    [("?", "\x1b", ":", "\x1b"),
     pytest.param(("/", "x", "\r", "/", "\x1b", "8", "o", "\x1b", "3", "\r", "\x1b"), marks=pytest.mark.slow)],
    ids=["help and line", "others"],
)  # fmt: skip
def test_finished_key_does_not_hold_up_the_next(typed: tuple[str, ...]) -> None:
    async def play(session: Session) -> None:
        for keys in typed:
            await at_once(session, keys)
            assert session.app._keyboard._current == 0, keys

    run(live(), play)


@pytest.mark.slow
@pytest.mark.parametrize("away", [((40, 10),), ((40, 10), (80, 24), (20, 5))], ids=["once", "twice"])
def test_prompt_regains_the_focus_when_the_terminal_is_large_again(away: tuple[tuple[int, int], ...]) -> None:
    async def play(session: Session) -> None:
        await edit(session, "max_speed")
        await session.type("2")
        for size in (*away, (80, 24)):
            await session.pilot.resize_terminal(*size)
            await session.settle()
        assert "esc Cancel" in session.lines()[-1]
        await session.type(".5")
        await session.press("enter")
        assert set_requests(session) == [("/robot_navigator", {"max_speed": 2.5})]

    run(live(), play)


@pytest.mark.slow
def test_prompt_of_a_pane_without_room_gets_the_focus_when_the_pane_is_chosen() -> None:
    async def play(session: Session) -> None:
        await session.press("z", "2", "0")
        await edit(session, "max_speed")
        await session.pilot.resize_terminal(40, 10)
        await session.settle()
        await session.press("2")
        await session.pilot.resize_terminal(80, 24)
        await session.settle()
        assert not session.app.stage.typing(), "another pane was chosen meanwhile"
        await session.press("1", "escape")
        assert not prompt(session).is_open

    run(live(), play)


@pytest.mark.parametrize(
    "opens",
    [pytest.param(("1", "e"), id="prompt"), pytest.param((":",), id="command line", marks=pytest.mark.slow)],
)
def test_all_stop_works_while_a_text_field_is_hidden_and_the_field_regains_the_focus(
    opens: tuple[str, ...],
) -> None:
    async def play(session: Session) -> None:
        await session.press(*opens)
        await session.pilot.resize_terminal(20, 5)
        await session.settle()
        assert next(line.strip() for line in session.lines() if line.strip()) == "20x5 is too small"
        await session.press("exclamation_mark")
        assert session.console.current.drive.stops
        await session.pilot.resize_terminal(80, 24)
        await session.settle()
        assert session.app.stage.typing() and "esc Cancel" in session.lines()[-1]
        await session.press("escape")
        assert not session.app.stage.typing()

    run(live(), play)


@pytest.mark.slow
@pytest.mark.parametrize("opens", ["ctrl+p", "question_mark"])
def test_pane_regains_the_focus_after_a_box_that_was_open_while_the_terminal_was_too_small(opens: str) -> None:
    async def play(session: Session) -> None:
        await session.press("8", opens)
        for size in ((20, 5), (80, 24)):
            await session.pilot.resize_terminal(*size)
            await session.settle()
        await session.press("escape")
        await session.settle()
        assert len(session.app.screen_stack) == 1
        assert "o Open  s Start" in session.lines()[-1]
        focused = session.app.focused
        assert focused is not None and session.pane(LaunchPane) in focused.ancestors_with_self

    run(live(), play)
