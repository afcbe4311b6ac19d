"""Text that nodes and people write is shown as it is written, everywhere: never as markup."""

from __future__ import annotations

import random
from collections.abc import Iterable

import pytest
from bot_console.tui.pane_table import PANES, PaneEntry
from bot_console.tui.panes.graph.pane import GraphPane
from bot_console.tui.screens.facts import FactsScreen
from bot_console.tui.screens.output import OutputScreen
from bot_console.tui.screens.question_screens import screen_for
from bot_console.tui.widgets.prompt.question import Choice, Confirmation, Line, Option
from piloting import Session, run
from samples import hostile, live

CHARACTERS = [
    "[",
    "]",
    "/",
    "\\",
    "[/",
    "[/]",
    "[red]",
    "[b",
    "[@click=app.quit]",
    "x",
    " ",
    "=",
    '"',
    "'",
    "\r",
    "$",
    "{",
    ":smile:",
    "#",
]
DRAWN = ["[/[@click=app.quit]x[/]"]
MORE = ["a\\", "[/", "\\[", *("".join(random.Random(seed).choices(CHARACTERS, k=8)) for seed in range(4))]
KEYS = {
    "graph": ["down", "enter"],
    "launch": ["down", "enter", "escape", "K"],
    "logs": ["enter", "escape", "y", "slash"],
    "parameters": ["end", "y", "e"],
    "plot": ["a"],
    "profiles": ["enter"],
}


each_text = pytest.mark.parametrize("text", [*DRAWN, *(pytest.param(each, marks=pytest.mark.soak) for each in MORE)])


async def draw_everywhere(session: Session, text: str, panes: Iterable[PaneEntry]) -> None:
    session.console.change(problem=text)
    await session.press("0")
    for entry in panes:
        for key in (entry.key, *KEYS.get(entry.id, []), "escape", "escape"):
            await session.press(key)


@pytest.mark.parametrize(
    "text",
    [*(pytest.param(each, marks=pytest.mark.slow) for each in DRAWN),
     *(pytest.param(each, marks=pytest.mark.soak) for each in MORE)],
)  # fmt: skip
def test_any_text_is_drawn_in_every_pane(text: str) -> None:
    async def play(session: Session) -> None:
        await draw_everywhere(session, text, PANES)

    run(hostile(text), play, (120, 40))


@each_text
def test_any_text_is_drawn_in_the_overview_and_in_every_overlay(text: str) -> None:
    async def play(session: Session) -> None:
        await draw_everywhere(session, text, [])
        session.console.change(problem="")
        await session.settle()
        pane = session.pane(GraphPane)
        for severity in ("information", "warning", "error"):
            pane.notify(text, title=text, severity=severity)
        questions = (
            Line(text, print, text=text, check=lambda _: text, suggestions=[text]),
            Confirmation(text, print, reasons=text),
            Choice(text, print, find=lambda _: [Option(text, text)], hint=text, empty=text),
            Choice(text, print, hint=text, empty=text),
        )
        for question in questions:
            pane.ask(question)
            await session.settle()
            await session.press("escape")
        for screen in (FactsScreen(text, [(text, [text])]), OutputScreen(text, text)):
            session.app.push_screen(screen)
            await session.settle()
            await session.press("escape")

    run(hostile(text), play, (120, 40))


@pytest.mark.parametrize("texts", [("[red]evil[/red]",), pytest.param(("[/", "\\[x]"), marks=pytest.mark.slow)])
def test_text_is_shown_character_by_character(texts: tuple[str, ...]) -> None:
    async def play(session: Session) -> None:
        for text in texts:
            session.app.clear_notifications()
            session.app.notify(text, title=text)
            session.app.push_screen(screen_for(Confirmation(text, print, reasons=text)))
            await session.settle()
            assert session.text().count(text) >= 4, text
            await session.press("escape")
            session.app.push_screen(OutputScreen(text, text))
            await session.settle()
            assert session.text().count(text) >= 2, text
            await session.press("escape")

    run(live(), play, (120, 40))


@pytest.mark.parametrize(
    "typed",
    [("[/",), pytest.param(("\\", "ros2 [/red]", "ros2 topic echo [b", "[@click=app.quit]x"), marks=pytest.mark.slow)],
    ids=["short", "long"],
)
def test_palette_accepts_any_text(typed: tuple[str, ...]) -> None:
    async def play(session: Session) -> None:
        for line in typed:
            await session.press("colon")
            before = session.text().count(line)
            await session.type(line)
            assert session.text().count(line) > before, line
            await session.press("enter", "enter", "escape", "escape")
            session.app.clear_notifications()
            await session.settle()

    run(hostile("[/[@click=app.quit]x"), play)
