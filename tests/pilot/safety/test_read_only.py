"""A read-only console refuses when a key is pressed, not after a question has been answered."""

from __future__ import annotations

from collections.abc import Sequence

import pytest
from bot_console.tui.console.command_gate import READ_ONLY
from bot_console.tui.console.model import Capabilities, Kind
from bot_console.tui.keymap import READ_ONLY_WORDS, TABLE
from bot_console.tui.screens.question import QuestionScreen
from bot_console.tui.widgets.prompt.line import Prompt
from piloting import Session, run
from samples import live, with_array

KEYS = {
    "a value": ("1", "slash", *"max_speed", "enter", "enter"),
    "an array": ("1", "slash", *"a_list", "enter", "enter"),
    "a way back": ("H", "down", "down", "u"),
    "a profile": ("7", "enter"),
    "an end": ("8", "down", "K"),
    "a launch file": ("8", "o"),
}


@pytest.mark.parametrize("digits", ["16", pytest.param("789H", marks=pytest.mark.slow)])
def test_key_bar_of_a_read_only_console_names_only_keys_that_it_obeys(digits: str) -> None:
    async def play(session: Session) -> None:
        assert "More" in session.lines()[-1]
        session.console.change(capabilities=Capabilities(change=READ_ONLY))
        session.app.pull()
        await session.settle()
        for pane in digits:
            await session.press(pane)
            words = session.lines()[-1].split()
            for word in (
                "Edit",
                "More",
                "Less",
                "Undo",
                "Apply",
                "Arm",
                "Kill",
                "Restart",
                "Publish",
                "Back",
                "Faster",
            ):
                assert word not in words, (pane, word)
            assert {"?", "!"} <= {*words}, "help and stop are named"
        ids = {key.id for keys in TABLE.values() for key in keys}
        assert READ_ONLY_WORDS.keys() <= ids

    run(live(), play, (200, 50))


BY_DEFAULT = ("a value", "a profile", "an end")


@pytest.mark.parametrize(
    "kinds",
    [BY_DEFAULT, pytest.param([each for each in KEYS if each not in BY_DEFAULT], marks=pytest.mark.slow)],
    ids=["first", "others"],
)
def test_read_only_console_refuses_before_asking(kinds: Sequence[str]) -> None:
    async def play(session: Session) -> None:
        session.console.change(capabilities=Capabilities(change=READ_ONLY))
        for what in kinds:
            keys = KEYS[what]
            session.app.clear_notifications()
            await session.press(*keys)
            assert not isinstance(session.app.screen, QuestionScreen), what
            assert not any(each.has_class("open") for each in session.app.screen.query(Prompt)), what
            assert [each.message for each in session.app._notifications] == [READ_ONLY], what
            assert not [each for each in session.console.asked if each[0] != "watch"], what
            assert session.launcher.asked == [], what
            await session.press("escape", "escape")

    run(with_array(Kind.DOUBLE_ARRAY, (1.0, 2.0)), play, (120, 40))
