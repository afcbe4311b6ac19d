"""A `!` behind keys that are not done yet holds the robot before its turn comes, and does not release it then."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from bot_console.tui.keymap import TABLE
from bot_console.tui.keys.remapping import remap
from bot_console.tui.look import Look
from piloting import Session, run
from samples import live
from textual import events

STOP = "exclamation_mark"
Later = Callable[[], None]


def held(session: Session) -> bool:
    return bool(session.console.current.drive.stopped_here)


async def behind(session: Session, *keys: str) -> list[Later]:
    """Type keys of which none has its turn yet; what is to be looked at when they have waited too long."""
    looks: list[Later] = []
    session.app.parts.late_stop.later = looks.append
    await session.app._keyboard.hold(lambda _: False)
    for each in keys:
        session.app.post_message(events.Key(each, "!" if each == STOP else each))
    await session.settle()
    return looks


async def their_turn(session: Session) -> None:
    await session.app._keyboard.let_go()
    await session.settle()


def test_the_robot_does_not_wait_for_the_keys_before() -> None:
    async def play(session: Session) -> None:
        (look,) = await behind(session, "3", "2", STOP)
        assert not held(session)
        look()
        assert held(session)
        await their_turn(session)
        assert held(session), "its turn released what it had held"
        assert "2 Logs" in session.text()
        await session.press(STOP)
        assert not held(session)

    run(live(), play)


def test_two_of_them_hold_and_release_as_they_were_typed() -> None:
    async def play(session: Session) -> None:
        first, second = await behind(session, "3", STOP, STOP)
        first()
        second()
        assert held(session)
        await their_turn(session)
        assert not held(session)

    run(live(), play)


def test_one_that_would_release_waits_for_its_turn() -> None:
    async def play(session: Session) -> None:
        await session.press(STOP)
        (look,) = await behind(session, "3", STOP)
        look()
        assert held(session)
        await their_turn(session)
        assert not held(session)

    run(live(), play)


def test_in_a_text_it_is_a_letter() -> None:
    async def play(session: Session) -> None:
        await session.press("2", "slash")
        looks = await behind(session, STOP)
        looks.pop()()
        assert not held(session) and len(looks) == 1, "it is looked at again"
        await their_turn(session)
        looks.pop()()
        assert not held(session) and session.app.focused.value == "!" and not looks

    run(live(), play)


def test_one_that_had_its_turn_in_time_holds_once() -> None:
    async def play(session: Session) -> None:
        (look,) = await behind(session, "3", STOP)
        await their_turn(session)
        assert held(session)
        await session.press(STOP)
        look()
        assert not held(session)

    run(live(), play)


def test_a_key_that_a_person_has_given_it_does_not_wait_either(monkeypatch: pytest.MonkeyPatch) -> None:
    for scope, keys in list(TABLE.items()):
        monkeypatch.setitem(TABLE, scope, keys)

    async def play(session: Session) -> None:
        (look,) = await behind(session, "3", "f9")
        look()
        assert held(session)
        await their_turn(session)
        assert held(session)

    run(live(), play, look=Look(keys=remap({"app.stop": "f9"})))
