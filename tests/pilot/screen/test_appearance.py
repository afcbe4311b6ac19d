"""Colours, glyphs and keys as configured."""

from __future__ import annotations

import pytest
from bot_console.tui.app import BotConsoleApp
from bot_console.tui.keymap import TABLE
from bot_console.tui.keys.remapping import remap
from bot_console.tui.settings.appearance import Appearance
from bot_console.tui.terminal.ascii import plain_text
from bot_console.tui.theme import THEMES
from bot_console.tui.widgets.key_bar import KeyBar
from bot_console.tui.widgets.tabs import Tabs
from emulator import Emulator
from hypothesis import given
from hypothesis import strategies as st
from piloting import Session, run
from rich.cells import cell_len
from samples import live
from textual.color import Color


@pytest.mark.parametrize(
    "digits", [pytest.param("046", marks=pytest.mark.slow), pytest.param("12345678", marks=pytest.mark.soak)]
)
def test_panes_are_drawn_in_every_theme(digits: str) -> None:
    async def play(session: Session) -> None:
        seen = []
        for _ in THEMES:
            await session.press("ctrl+y")
            seen.append(session.app.theme)
            for digit in digits:
                await session.press(digit)
        assert sorted(seen) == sorted(each.name for each in THEMES.values())

    run(live(), play, (120, 40))


def test_tabs_and_keys_change_colour_with_the_theme() -> None:
    async def play(session: Session) -> None:
        for _ in THEMES:
            await session.press("ctrl+y")
            primary = session.app.theme_variables["primary"].removeprefix("ansi_").lower()
            for each in (KeyBar, Tabs):
                styles = [span.style for span in session.app.query_one(each).content.spans if span.style]
                assert {style.color.name for style in styles if style.color} == {primary}

    run(live(), play, (120, 40))


@pytest.mark.parametrize("name", ["dark", "light", "high-contrast"])
def test_coloured_text_has_enough_contrast(name: str) -> None:
    theme = THEMES[name]
    grounds = [Color.parse(each) for each in (theme.surface, theme.panel, theme.background)]
    words = [theme.foreground, theme.primary, theme.secondary, theme.success, theme.warning, theme.error]
    for word in (*words, *(theme.variables[f"curve-{number}"] for number in range(6))):
        for ground in grounds:
            assert contrast(Color.parse(word), ground) >= 3.0, (word, ground)
    cursor = (theme.variables["block-cursor-foreground"], theme.variables["block-cursor-background"])
    assert contrast(*map(Color.parse, cursor)) >= 4.5


def contrast(one: Color, other: Color) -> float:
    """The contrast ratio of WCAG 2.1."""

    def luminance(colour: Color) -> float:
        parts = [each / 255 for each in colour.rgb]
        linear = [each / 12.92 if each <= 0.03928 else ((each + 0.055) / 1.055) ** 2.4 for each in parts]
        return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]

    high, low = sorted((luminance(one), luminance(other)), reverse=True)
    return (high + 0.05) / (low + 0.05)


@given(st.text(alphabet=st.characters(exclude_categories=("Cs", "Cc", "Mn", "Me", "Cf"))))
def test_plain_characters_are_ascii_of_the_same_width(text: str) -> None:
    assert plain_text(text).isascii()
    assert cell_len(plain_text(text)) == sum(map(cell_len, text))


@pytest.mark.parametrize("digits", ["04", pytest.param("1235678", marks=pytest.mark.slow)])
def test_every_drawing_character_has_an_ascii_substitute(digits: str) -> None:
    async def play(session: Session) -> None:
        for digit in digits:
            await session.press(digit)
            drawn = {character for character in session.text() if not character.isascii()}
            assert not [character for character in drawn if plain_text(character) == "?"]

    run(live(), play, (120, 40))


def test_ctrl_g_sends_everything_again_in_ascii_and_back() -> None:
    async def play(session: Session) -> None:
        terminal = Emulator(80, 24)

        def is_ascii() -> bool:
            strips = session.app.screen._compositor.render_strips()
            terminal.feed(session.app._difference(session.app.size, {y: {0: each} for y, each in enumerate(strips)}))
            assert "Parameters" in "".join(terminal.lines())
            return "".join(terminal.lines()).isascii()

        assert not is_ascii()
        await session.press("ctrl+g")
        assert is_ascii()
        await session.press("ctrl+g")
        assert not is_ascii()

    run(live(), play)


def test_action_is_remapped_to_another_key(monkeypatch: pytest.MonkeyPatch) -> None:
    for scope, keys in list(TABLE.items()):
        monkeypatch.setitem(TABLE, scope, keys)

    async def play(session: Session) -> None:
        app = BotConsoleApp(session.console, refresh_hz=0, appearance=Appearance(keys=remap({"app.zoom": "f9"})))
        async with app.run_test(size=(120, 40)) as pilot:
            await pilot.press("z")
            assert len(app.visible_panes()) > 1
            await pilot.press("f9")
            assert len(app.visible_panes()) == 1

    run(live(), play)
