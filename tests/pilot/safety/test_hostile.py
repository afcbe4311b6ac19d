"""Texts from outside never act on the terminal, whichever pane shows them."""

from __future__ import annotations

import unicodedata

import pytest
from bot_console.tui.pane_table import PANES
from bot_console.tui.screens.facts import FactsScreen
from bot_console.tui.screens.output import OutputScreen
from bot_console.tui.terminal.cells import cells_of
from piloting import Session, run
from rich.color import ColorSystem
from samples import BELL, empty, hostile


def harmful(text: str) -> list[str]:
    return [f"U+{ord(each):04X}" for each in text if unicodedata.category(each) in ("Cc", "Cf", "Co", "Cn", "Cs")]


KEYS = {
    "graph": ["down", "right", "enter"],
    "launch": ["down", "enter"],
    "logs": ["enter"],
    "parameters": ["end", *["down"] * 16, "enter"],
    "plot": ["a"],
    "profiles": ["enter"],
}


each_pane = pytest.mark.parametrize("digits", ["28", pytest.param("1345679HMBI", marks=pytest.mark.slow)])
"""The default run tries the panes that show what programs print, and those of the overview."""


@each_pane
def test_no_control_character_reaches_the_screen(digits: str) -> None:
    async def play(session: Session) -> None:
        await session.press("0")
        for line in session.lines():
            assert harmful(line) == [], line
        entries = [each for each in PANES if each.key in digits]
        assert len(entries) == len(digits)
        for entry in entries:
            for key in (entry.key, *KEYS.get(entry.id, [])):
                await session.press(key)
                for line in session.lines():
                    assert harmful(line) == [], (entry.id, key, line)
            assert session.app.current_pane.id == entry.id
            await session.press("escape", "escape")

    run(hostile(), play, (120, 40))


@each_pane
def test_hostile_problem_text_is_sanitized_in_every_pane(digits: str) -> None:
    system = empty()
    system[0].change(problem=BELL)

    async def play(session: Session) -> None:
        for entry in (each for each in PANES if each.key in digits):
            await session.press(entry.key)
            for line in session.lines():
                assert harmful(line) == [], (entry.id, line)

    run(system, play, (120, 40))


def test_markup_is_shown_literally() -> None:
    async def play(session: Session) -> None:
        await session.press("2")
        assert "evil[red]" in session.text()
        await session.press("8")
        assert "evil[red]" in session.text()
        await session.press("enter", "down", "enter")
        assert "evil[red]" in session.text()

    run(hostile(), play, (120, 40))


def test_arguments_form_and_picker_sanitize_text() -> None:
    async def play(session: Session) -> None:
        await session.press("8", "o")
        assert harmful(session.text().replace("\n", "")) == []
        await session.press("enter")
        await session.app.workers.wait_for_complete()
        await session.settle()
        # The value of a field is the person's own text, and Textual shows it cell by cell.
        assert "evil[red]" in session.text()

    run(hostile(), play, (120, 40))


def test_detail_screen_heading_contains_no_control_character() -> None:
    async def play(session: Session) -> None:
        for screen in (FactsScreen(BELL, [(BELL, [BELL])]), OutputScreen(BELL, BELL)):
            session.app.push_screen(screen)
            await session.settle()
            for strip in session.app.screen._compositor.render_strips():
                written = "".join(cells_of(strip, ColorSystem.TRUECOLOR).characters)
                assert harmful(written) == [], written
            await session.press("escape")

    run(hostile(), play, (120, 40))
