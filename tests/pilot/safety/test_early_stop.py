"""A `!` behind unhandled input holds the robot at once; when it is handled, it turns out whether it was text."""

from __future__ import annotations

import pytest
from bot_console.tui.keymap import TABLE
from bot_console.tui.keys.remapping import remap
from bot_console.tui.settings.appearance import Appearance
from piloting import Session, run
from samples import live
from textual import events

STOP = "exclamation_mark"


def is_held(session: Session) -> bool:
    return bool(session.console.current.drive.stopped_here)


async def type_unhandled(session: Session, *keys: str) -> None:
    """Type keys as the reading thread sees them, without letting any of them have its turn."""
    await session.app._keyboard.hold(lambda _: False)
    for each in keys:
        event = events.Key(each, "!" if each == STOP else each if len(each) == 1 else None)
        if session.app.early_stop.is_stop(event):
            session.app.early_stop.typed(event, alone=True)
        session.app.post_message(event)
        await session.settle()


async def their_turn(session: Session) -> None:
    await session.app._keyboard.detach()
    await session.settle()


def test_stop_overtakes_earlier_keys_and_does_not_release_in_its_turn() -> None:
    async def play(session: Session) -> None:
        await type_unhandled(session, "3", "2", STOP)
        session.app.pull()
        assert is_held(session) and "! holds it again" in session.text()
        await their_turn(session)
        assert is_held(session), "handling the key released its own early stop"
        await session.settle()
        assert "! releases" in session.text()
        await session.press(STOP)
        assert not is_held(session)

    run(live(), play)


def test_second_press_before_the_stop_is_shown_does_not_release() -> None:
    async def play(session: Session) -> None:
        await type_unhandled(session, "3", STOP, STOP, STOP, STOP)
        await their_turn(session)
        assert is_held(session)

    run(live(), play)


def test_press_releases_a_stop_that_was_shown() -> None:
    async def play(session: Session) -> None:
        await session.press(STOP)
        await type_unhandled(session, "3", STOP)
        assert is_held(session)
        await their_turn(session)
        assert not is_held(session)

    run(live(), play)


def test_press_at_a_robot_that_moves_again_stops_it_even_if_the_screen_still_says_held() -> None:
    async def play(session: Session) -> None:
        await session.press(STOP)
        shown = session.app._snapshot
        await session.press(STOP)
        assert not is_held(session)
        await type_unhandled(session, "3")
        session.app._snapshot = shown  # as on a machine that is too busy to draw
        await type_unhandled(session, STOP)
        assert is_held(session)
        await their_turn(session)
        assert is_held(session), "the robot was released again"

    run(live(), play)


def test_stop_key_typed_into_a_new_text_field_is_withdrawn_and_inserted() -> None:
    async def play(session: Session) -> None:
        await session.press("2")
        await type_unhandled(session, "slash", STOP)
        assert is_held(session), "it is not known yet that the key is text"
        await their_turn(session)
        assert not is_held(session) and session.app.focused.value == "!"

    run(live(), play)


def test_typed_character_keeps_the_stop_of_another_press() -> None:
    async def play(session: Session) -> None:
        await session.press("2")
        await type_unhandled(session, STOP, "slash", STOP)
        await their_turn(session)
        assert session.app.focused.value == "!"
        assert is_held(session), session.console.asked

    run(live(), play)


@pytest.mark.parametrize(
    "keys",
    [
        ("question_mark",),
        *(
            pytest.param(each, marks=pytest.mark.slow)
            for each in (("V",), ("ctrl+p", "escape"), ("1", "enter", "escape"), ("colon", "escape"))
        ),
    ],
)
def test_stop_works_over_every_screen(keys: tuple[str, ...]) -> None:
    async def play(session: Session) -> None:
        await type_unhandled(session, *keys, STOP)
        assert is_held(session)
        await their_turn(session)
        assert is_held(session)

    run(live(), play)


def test_remapped_stop_key_also_stops_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    for scope, keys in list(TABLE.items()):
        monkeypatch.setitem(TABLE, scope, keys)

    async def play(session: Session) -> None:
        await type_unhandled(session, "3", "f9")
        assert is_held(session)
        await their_turn(session)
        assert is_held(session)

    run(live(), play, appearance=Appearance(keys=remap({"app.stop": "f9"})))
