"""A text of several lines: those that stay the same are not drawn anew, and what is seen is what was said last."""

from __future__ import annotations

import asyncio
import random
from unittest.mock import patch

import pytest
from bot_console.tui.widgets.words import Words
from rich.text import Text
from textual.app import App, ComposeResult


class Said(App[None]):
    CSS = "Words { height: 6; } .wrapped { text-wrap: wrap; }"

    def compose(self) -> ComposeResult:
        yield Words()

    def lines(self) -> list[str]:
        return [strip.text.strip() for strip in self.screen._compositor.render_strips()][:6]


def text(*lines: str, style: str = "") -> Text:
    said = Text()
    for each in lines:
        said.append(f"{each}\n", style)
    return said


def drawn(widget: Words) -> list[int]:
    """The rows that are drawn next."""
    return sorted({y for region in widget._repaint_regions for y in region.line_range})


def test_only_lines_that_are_others_are_drawn() -> None:
    async def main() -> None:
        app = Said()
        async with app.run_test(size=(20, 8)) as pilot:
            words = app.query_one(Words)
            words.say(text("one", "two", "three"))
            await pilot.pause()
            words.say(text("one", "2", "three"))
            assert drawn(words) == [1]
            await pilot.pause()
            words.say(text("one"))
            assert drawn(words) == [1, 2, 3]
            await pilot.pause()
            assert app.lines() == ["one", "", "", "", "", ""]
            words.say(text("one", style="bold"))
            assert drawn(words) == [0]
            await pilot.pause()
            words.say("a line")
            assert drawn(words) == [*range(6)], "nothing is known of the lines of a plain text"
            await pilot.pause()
            words.add_class("wrapped")
            await pilot.pause()
            words.say(text("one", "two"))
            await pilot.pause()
            words.say(text("one", "a line that is wrapped"))
            assert drawn(words) == [*range(6)], "a line may take more rows than one"

    asyncio.run(main())


@pytest.mark.parametrize("seed", range(4))
def test_whatever_is_said_is_seen(seed: int) -> None:
    async def main() -> None:
        draw = random.Random(seed)
        app = Said()
        async with app.run_test(size=(20, 8)) as pilot:
            words = app.query_one(Words)
            for _ in range(40):
                lines = [draw.choice(("one", "two", "", "three")) for _ in range(draw.randrange(9))]
                if draw.random() < 0.2:
                    lines = lines[:1]
                    words.say("".join(lines))
                else:
                    words.say(text(*lines, style=draw.choice(("", "bold"))))
                if draw.random() < 0.5:
                    await pilot.pause()
                    assert app.lines() == [*lines, *[""] * 6][:6]

    asyncio.run(main())


def test_what_is_said_again_is_not_drawn() -> None:
    async def main() -> None:
        app = Said()
        async with app.run_test(size=(20, 8)):
            words = app.query_one(Words)
            words.say(text("one", "two"))
            with patch.object(Words, "refresh", autospec=True, side_effect=Words.refresh) as refresh:
                words.say(text("one", "two"))
            assert refresh.call_count == 0

    asyncio.run(main())
