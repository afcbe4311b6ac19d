"""Keys typed faster than the console handles them: a held key does not go on after its release, but stops are kept."""

from __future__ import annotations

from bot_console.tui.keys import keyboard
from bot_console.tui.keys.keyboard import MAX_REPEATS, MAX_WAITING_KEYS
from bot_console.tui.widgets.command_line import CommandField
from piloting import Session, run
from pytest import MonkeyPatch
from samples import live
from textual import events
from textual.widgets import Input

STOP = "exclamation_mark"


async def type_unhandled(session: Session, *keys: str) -> list[str]:
    """Type keys without letting any of them have its turn; return those that wait."""
    await session.app._keyboard.hold(lambda _: False)
    for each in keys:
        session.app.post_message(events.Key(each, "!" if each == STOP else each))
    await session.settle()
    return [each.key for each in session.app._keyboard._waiting if isinstance(each, events.Key)]


def test_held_key_acts_only_a_few_times_after_its_release() -> None:
    async def play(session: Session) -> None:
        waiting = await type_unhandled(session, *"x" * 3 * MAX_REPEATS, *"yx" * MAX_REPEATS)
        assert waiting == [*"x" * MAX_REPEATS, *"yx" * MAX_REPEATS]

    run(live(), play)


def test_stops_are_never_dropped() -> None:
    async def play(session: Session) -> None:
        stops = [STOP] * (3 * MAX_REPEATS)
        assert await type_unhandled(session, *stops) == stops

    run(live(), play)


def test_typed_text_is_not_dropped() -> None:
    async def play(session: Session) -> None:
        await session.press("colon")
        assert len(await type_unhandled(session, *"a" * 3 * MAX_REPEATS)) == 3 * MAX_REPEATS
        await session.app._keyboard.detach()
        await session.settle()
        assert session.pane(CommandField).query_one(Input).value == "a" * 3 * MAX_REPEATS

    run(live(), play)


def test_waiting_keys_are_limited_except_stops(monkeypatch: MonkeyPatch) -> None:
    assert MAX_WAITING_KEYS > 100 * MAX_REPEATS
    monkeypatch.setattr(keyboard, "MAX_WAITING_KEYS", 2 * MAX_REPEATS)

    async def play(session: Session) -> None:
        waiting = await type_unhandled(session, *"xy" * 3 * MAX_REPEATS, STOP)
        assert waiting == [*"xy" * MAX_REPEATS, STOP]

    run(live(), play)
