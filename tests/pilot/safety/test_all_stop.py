"""`!` holds the robot and releases this console's own stop; others' stops only after a question that names them."""

from __future__ import annotations

from dataclasses import replace

import pytest
from bot_console.tui.console.robot.robot_model import DriveInfo, RobotStop
from bot_console.tui.screens.confirm import ConfirmScreen
from piloting import Session, run
from samples import live

BEN = RobotStop("b", "ben\x1b[2J", "my [foot]")
NODE = RobotStop("node", "simulator", "the safety monitor has gone", by_node=True)
STOP = "exclamation_mark"


def stop_keys(session: Session) -> list[str]:
    return [each.key for each in session.console.current.drive.stops]


def test_holder_that_has_ended_is_marked_gone_at_80_columns() -> None:
    async def play(session: Session) -> None:
        session.console.hold([RobotStop("b", "bot-console of ben@lab (pid 12)", "ALL STOP", gone=True)])
        await session.settle()
        assert "ALL STOP held (! twice releases) by bot-console of ben@lab (gone)" in session.text()
        await session.press("6")
        assert "! twice releases: held by bot-console of ben@lab (gone)" in session.text()
        await session.press(STOP, STOP)
        assert "bot-console of ben@lab (gone): ALL STOP" in session.text()
        await session.press("y")
        assert stop_keys(session) == []

    run(live(), play, (80, 24))


def test_stop_key_holds_and_releases_the_robot() -> None:
    async def play(session: Session) -> None:
        await session.press(STOP)
        assert stop_keys(session) == ["ours"] and "ALL STOP held (! releases)" in session.text()
        await session.press(STOP)
        assert stop_keys(session) == []

    run(live(), play)


def test_stop_key_only_repeats_the_stop_while_searching_for_robots() -> None:
    async def play(session: Session) -> None:
        pending = DriveInfo(stopped=True, stopped_here=True, own_stops=frozenset(["ours"]), searching=True)
        session.console.change(drive=pending)
        await session.press(STOP)
        assert session.console.asked[-1] == ("all_stop", True)
        session.console.change(drive=pending)
        await session.settle()
        assert "STOP NOT CONFIRMED: looking for the robot (! sends it again)" in session.text()
        session.console.change(drive=replace(pending, searching=False))
        await session.settle()
        assert "STOP REACHES NOBODY" in session.text()
        await session.press(STOP)
        assert session.console.asked[-1] == ("all_stop", False)
        await session.settle()
        assert "The stop is withdrawn." in session.text() and "may move again" not in session.text()

    run(live(), play, (80, 24))


def test_first_press_adds_our_stop_and_second_asks_to_release_others() -> None:
    async def play(session: Session) -> None:
        session.console.hold([BEN])
        await session.settle()
        assert "(! holds it too, once more releases) by ben" in session.text()
        await session.press(STOP)
        assert stop_keys(session) == ["b", "ours"] and "held (! releases)" in session.text()
        await session.press(STOP)
        assert isinstance(session.app.screen, ConfirmScreen) and "my [foot]" in session.text()
        await session.press("n")
        assert stop_keys(session) == ["b", "ours"]
        await session.press(STOP, "y")
        assert stop_keys(session) == [] and session.console.asked[-1] == ("release", "b")

    run(live(), play, (120, 40))


@pytest.mark.parametrize(
    "opened",
    [(":",), *(pytest.param(each, marks=pytest.mark.slow) for each in (("1", "/"), ("1", "enter"), ("ctrl+p",)))],
)
def test_status_line_says_that_the_stop_key_is_typed_into_a_text_field(opened: tuple[str, ...]) -> None:
    async def play(session: Session) -> None:
        await session.press(STOP)
        assert "held (! releases)" in session.text()
        await session.press(*opened, STOP)
        session.app.pull()
        await session.settle()
        assert session.app.stage.typing() and stop_keys(session) == ["ours"]
        assert "held (! is a letter here)" in session.text()
        await session.press("escape")
        session.app.pull()
        await session.settle()
        assert "held (! releases)" in session.text()

    run(live(), play)


def test_stop_pressed_during_the_question_holds_without_asking_again() -> None:
    async def play(session: Session) -> None:
        session.console.hold([BEN])
        await session.press(STOP, STOP, STOP, STOP)
        assert stop_keys(session) == ["b", "ours"]
        assert len(session.app.screen_stack) == 2 and "held (! keeps it held)" in session.text()
        await session.press("n")
        assert len(session.app.screen_stack) == 1 and stop_keys(session) == ["b", "ours"]
        assert "held (! releases)" in session.text()

    run(live(), play)


def test_release_question_closes_when_others_have_released_their_stops() -> None:
    async def play(session: Session) -> None:
        session.console.hold([BEN])
        await session.press(STOP, STOP)
        session.console.hold([each for each in session.console.current.drive.stops if each.here])
        session.app.pull()
        await session.settle()
        assert len(session.app.screen_stack) == 1 and "have been released" in session.text()
        assert stop_keys(session) == ["ours"]

    run(live(), play)


def test_yes_does_not_release_a_stop_that_came_after_the_question() -> None:
    async def play(session: Session) -> None:
        session.console.hold([BEN])
        await session.press(STOP, STOP)
        session.console.hold([*session.console.current.drive.stops, RobotStop("c", "carl", "wait")])
        await session.press("y")
        assert stop_keys(session) == ["c"]

    run(live(), play)


def test_stop_of_a_node_is_released_without_a_question() -> None:
    async def play(session: Session) -> None:
        session.console.hold([NODE])
        await session.press(STOP, STOP)
        assert stop_keys(session) == []

    run(live(), play)
