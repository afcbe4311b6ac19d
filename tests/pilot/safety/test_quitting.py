"""Quitting asks only where values would be lost; the robot stands meanwhile, and nobody is asked twice."""

from __future__ import annotations

from dataclasses import replace

from bot_console.tui.console.robot.drive_link import BY_PERSON
from bot_console.tui.console.robot.robot_model import DriveInfo, RobotStop
from bot_console.tui.safety.quitting import REASON
from bot_console.tui.screens.confirm import ConfirmScreen
from piloting import Session, run
from samples import live
from textual import events

NODE = "/robot_navigator"


def stops(session: Session) -> list[bool]:
    return [each[1] for each in session.console.asked if each[0] == "all_stop"]


def has_ended(session: Session) -> bool:
    return not session.app.is_running or session.app._exit


async def set_turn_rate(session: Session) -> None:
    session.console.parameters.set(NODE, {"turn_rate": 1.5})
    await session.settle()


def test_quit_does_not_ask_without_unsaved_values() -> None:
    async def play(session: Session) -> None:
        await session.pilot.press("q")
        assert has_ended(session) and stops(session) == []

    run(live(), play)


def test_quit_names_unsaved_values_and_holds_the_robot_until_no() -> None:
    async def play(session: Session) -> None:
        await set_turn_rate(session)
        await session.press("q")
        assert isinstance(session.app.screen, ConfirmScreen) and not has_ended(session)
        assert f"{NODE} turn_rate = 1.5" in session.text()
        assert "held meanwhile" in session.text() and stops(session) == [True]
        await session.press("n")
        assert stops(session) == [True, False]
        assert not has_ended(session) and not session.console.current.drive.stopped

    run(live(), play)


def test_quit_does_not_ask_about_values_of_ended_nodes() -> None:
    async def play(session: Session) -> None:
        await set_turn_rate(session)
        here = session.console.current
        left = {name: tree for name, tree in here.parameters.items() if name != NODE}
        session.console.current = replace(here, parameters=left)
        await session.settle()
        await session.pilot.press("q")
        assert has_ended(session) and stops(session) == []

    run(live(), play)


def test_quit_question_stops_nothing_without_a_robot() -> None:
    async def play(session: Session) -> None:
        await set_turn_rate(session)
        session.console.current = replace(session.console.current, drive=DriveInfo())
        await session.settle()
        await session.press("q")
        assert "not saved:" in session.text() and "held meanwhile" not in session.text()
        await session.press("n")
        assert stops(session) == [] and not has_ended(session)

    run(live(), play)


def test_yes_quits_and_the_robot_stays_held() -> None:
    async def play(session: Session) -> None:
        await set_turn_rate(session)
        await session.press("q")
        await session.pilot.press("y")
        assert has_ended(session) and stops(session) == [True]

    run(live(), play)


def test_ctrl_q_twice_never_asks() -> None:
    async def play(session: Session) -> None:
        await set_turn_rate(session)
        await session.press("ctrl+q")
        assert not has_ended(session) and stops(session) == [True]
        await session.pilot.press("ctrl+q")
        assert has_ended(session)

    run(live(), play)


def test_keys_typed_before_ctrl_q_do_not_answer_its_question() -> None:
    async def play(session: Session) -> None:
        await set_turn_rate(session)
        early = [events.Key("q", "q"), events.Key("n", "n")]
        await session.press("ctrl+q")
        for each in early:
            session.app.post_message(each)
            await session.settle()
        assert isinstance(session.app.screen, ConfirmScreen) and stops(session) == [True]
        session.app.post_message(events.Key("n", "n"))
        await session.settle()
        assert stops(session) == [True, False] and not has_ended(session)

    run(live(), play)


def test_values_that_are_saved_undone_or_in_a_profile_count_as_kept() -> None:
    async def play(session: Session) -> None:
        await set_turn_rate(session)
        session.console.parameters.save("all.yaml")
        await session.pilot.press("q")
        assert has_ended(session)

    run(live(), play)


def test_answering_no_keeps_stops_from_before_and_during_the_question() -> None:
    async def play(session: Session) -> None:
        await set_turn_rate(session)
        await session.press("exclamation_mark", "q", "n")
        assert stops(session) == [True] and session.console.current.drive.stopped
        await session.press("exclamation_mark", "q")
        session.app.pull()
        await session.settle()
        assert "held (! keeps it held)" in session.text()
        await session.press("exclamation_mark")
        assert "held (! releases)" in session.text()
        await session.press("n")
        assert stops(session) == [True, False, True, True] and session.console.current.drive.stopped

    run(live(), play)


def test_stop_key_during_the_question_adds_the_persons_own_stop() -> None:
    """The stop of the question ends with the robot's nodes; a stop that a person has requested does not."""

    async def play(session: Session) -> None:
        await set_turn_rate(session)
        reasons: list[str] = []
        session.console.drive.stop = lambda hold, reason=BY_PERSON: reasons.append(reason)  # type: ignore[method-assign]
        await session.press("q", "exclamation_mark")
        assert reasons == [REASON, BY_PERSON]

    run(live(), play)


def test_answering_no_does_not_release_the_stop_of_another_console() -> None:
    ben = RobotStop("b", "ben", "my foot")

    async def play(session: Session) -> None:
        await set_turn_rate(session)
        await session.press("q")
        session.console.hold([*session.console.current.drive.stops, ben])
        await session.press("n")
        assert session.console.current.drive.stops == (ben,) and session.console.current.drive.stopped
        await session.press("q", "n")
        assert session.console.current.drive.stops == (ben,), "an earlier stop stays, too"

    run(live(), play)


def test_unsafe_edit_is_announced_once_with_the_undo_key() -> None:
    async def play(session: Session) -> None:
        for value in (0.4, 0.3):
            session.console.parameters.set(NODE, {"safety_distance": value})
            await session.settle()
        reported = [each.message for each in session.app._notifications]
        assert reported == ["⚠ safety_distance 0.8 → 0.4 lowers a safety margin. u in the Parameters pane undoes it."]
        session.console.parameters.set(NODE, {"safety_distance": 0.6})
        session.console.parameters.set(NODE, {"turn_rate": 0.5})
        await session.settle()
        assert len(session.app._notifications) == 1
        session.console.parameters.undo()
        await session.settle()
        *_, last = (each.message for each in session.app._notifications)
        assert last.startswith("⚠ turn_rate 0.5 → 1.0 raises a safety limit. U in the Parameters pane undoes it.")

    run(live(), play)
