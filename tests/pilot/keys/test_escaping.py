"""Esc and a character that arrive together are two keys, unless a key with Alt is bound to them."""

from __future__ import annotations

import pytest
from bot_console.tui.screens.help import HelpScreen
from piloting import Session, run
from samples import live
from textual import events

ALT_Q = "alt+q"


async def comes(session: Session, key: str, character: str | None) -> None:
    session.app.post_message(events.Key(key, character))
    await session.settle()


def test_escape_closes_the_overlay_and_the_next_key_reaches_the_pane() -> None:
    async def play(session: Session) -> None:
        await session.press("question_mark")
        assert isinstance(session.app.screen, HelpScreen)
        await comes(session, "alt+shift+t", "T")
        assert not isinstance(session.app.screen, HelpScreen)

    run(live(), play)


def test_escape_followed_by_q_quits() -> None:
    async def play(session: Session) -> None:
        await comes(session, ALT_Q, "q")
        assert not session.app.is_running or session.app._exit

    run(live(), play)


def test_alt_reported_by_the_terminal_is_not_escape() -> None:
    async def play(session: Session) -> None:
        await comes(session, ALT_Q, None)
        assert not session.app._exit

    run(live(), play)


@pytest.mark.slow
def test_key_bound_with_alt_is_not_split() -> None:
    async def play(session: Session) -> None:
        session.app.set_keymap({"app.help": ALT_Q})
        await comes(session, ALT_Q, "q")
        assert isinstance(session.app.screen, HelpScreen)

    run(live(), play)
