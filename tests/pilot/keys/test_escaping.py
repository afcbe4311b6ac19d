"""Esc and a letter that come in one piece are what a person typed, unless somebody has bound the letter with Alt."""

from __future__ import annotations

from bot_console.tui.screens.help import HelpScreen
from piloting import Session, run
from samples import live
from textual import events

ALT_Q = "alt+q"


async def comes(session: Session, key: str, character: str | None) -> None:
    session.app.post_message(events.Key(key, character))
    await session.settle()


def test_esc_closes_what_lies_over_the_panes_and_the_character_acts_behind_it() -> None:
    async def play(session: Session) -> None:
        await session.press("question_mark")
        assert isinstance(session.app.screen, HelpScreen)
        await comes(session, "alt+shift+t", "T")
        assert not isinstance(session.app.screen, HelpScreen)

    run(live(), play)


def test_esc_and_q_end_the_console() -> None:
    async def play(session: Session) -> None:
        await comes(session, ALT_Q, "q")
        assert not session.app.is_running or session.app._exit

    run(live(), play)


def test_alt_that_the_terminal_distinguishes_is_no_esc() -> None:
    async def play(session: Session) -> None:
        await comes(session, ALT_Q, None)
        assert not session.app._exit

    run(live(), play)


def test_a_key_that_a_person_has_bound_with_alt_is_that_key() -> None:
    async def play(session: Session) -> None:
        session.app.set_keymap({"app.help": ALT_Q})
        await comes(session, ALT_Q, "q")
        assert isinstance(session.app.screen, HelpScreen)

    run(live(), play)
