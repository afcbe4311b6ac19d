"""A text of several lines: unchanged lines are not drawn again, and the screen shows the latest text."""

from __future__ import annotations

import asyncio
import random
from unittest.mock import patch

import pytest
from bot_console.tui.widgets.static_text import StaticText
from rich.text import Text
from sampling import slow_after
from textual.app import App, ComposeResult


class PrintedText(App[None]):
    CSS = "StaticText { height: 6; } .wrapped { text-wrap: wrap; }"

    def compose(self) -> ComposeResult:
        yield StaticText()

    def lines(self) -> list[str]:
        return [strip.text.strip() for strip in self.screen._compositor.render_strips()][:6]


def text(*lines: str, style: str = "") -> Text:
    message = Text()
    for each in lines:
        message.append(f"{each}\n", style)
    return message


def drawn_rows(widget: StaticText) -> list[int]:
    """The rows that are drawn next."""
    return sorted({y for region in widget._repaint_regions for y in region.line_range})


def test_only_changed_lines_are_drawn() -> None:
    async def main() -> None:
        app = PrintedText()
        async with app.run_test(size=(20, 8)) as pilot:
            words = app.query_one(StaticText)
            words.show_text(text("one", "two", "three"))
            await pilot.pause()
            words.show_text(text("one", "2", "three"))
            assert drawn_rows(words) == [1]
            await pilot.pause()
            words.show_text(text("one"))
            assert drawn_rows(words) == [1, 2, 3]
            await pilot.pause()
            assert app.lines() == ["one", "", "", "", "", ""]
            words.show_text(text("one", style="bold"))
            assert drawn_rows(words) == [0]
            await pilot.pause()
            words.show_text("a line")
            assert drawn_rows(words) == [*range(6)], "the lines of a plain text are unknown"
            await pilot.pause()
            words.add_class("wrapped")
            await pilot.pause()
            words.show_text(text("one", "two"))
            await pilot.pause()
            words.show_text(text("one", "a line that is wrapped"))
            assert drawn_rows(words) == [*range(6)], "a line may take more rows than one"

    asyncio.run(main())


@pytest.mark.parametrize("seed", slow_after(1, range(4)))
def test_every_message_is_visible(seed: int) -> None:
    async def main() -> None:
        draw = random.Random(seed)
        app = PrintedText()
        async with app.run_test(size=(20, 8)) as pilot:
            words = app.query_one(StaticText)
            for _ in range(40):
                lines = [draw.choice(("one", "two", "", "three")) for _ in range(draw.randrange(9))]
                if draw.random() < 0.2:
                    lines = lines[:1]
                    words.show_text("".join(lines))
                else:
                    words.show_text(text(*lines, style=draw.choice(("", "bold"))))
                if draw.random() < 0.5:
                    await pilot.pause()
                    assert app.lines() == [*lines, *[""] * 6][:6]

    asyncio.run(main())


def test_the_same_text_is_not_drawn_again() -> None:
    async def main() -> None:
        app = PrintedText()
        async with app.run_test(size=(20, 8)):
            words = app.query_one(StaticText)
            words.show_text(text("one", "two"))
            with patch.object(StaticText, "refresh", autospec=True, side_effect=StaticText.refresh) as refresh:
                words.show_text(text("one", "two"))
            assert refresh.call_count == 0

    asyncio.run(main())
