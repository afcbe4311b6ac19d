"""Changed parts are composed as by Textual, and only visible lines are rendered."""

from __future__ import annotations

import asyncio
import random
from typing import Any

import pytest
from bot_console.tui.terminal.output import HoldingScreen
from textual._compositor import ChopsUpdate, Compositor
from textual.app import App, ComposeResult
from textual.containers import Container, Horizontal, VerticalScroll
from textual.geometry import Region
from textual.screen import Screen
from textual.strip import Strip
from textual.widgets import Static

WIDTH, HEIGHT = 40, 12


class CountingWidget(Static):
    """Counts the lines that are requested of it."""

    asked = 0

    def render_lines(self, crop: Region) -> list[Strip]:
        self.asked += crop.height
        return super().render_lines(crop)


class Panes(App[None]):
    """Frames beside each other, a long text that is scrolled in one of them, and a box over both."""

    CSS = """
    Screen { layers: below above; }
    Horizontal { height: 1fr; }
    Container { width: 1fr; border: round white; }
    #long { height: 30; }
    #over { layer: above; offset: 14 4; width: 11; height: 3; background: red; }
    #foot { height: 1; }
    """

    def get_default_screen(self) -> Screen[Any]:
        return HoldingScreen()

    def compose(self) -> ComposeResult:
        with Horizontal():
            yield Container(CountingWidget("\n".join(f"left {each}" for each in range(8)), id="left"))
            with VerticalScroll():
                yield CountingWidget("\n".join(f"long {each} 漢字" for each in range(30)), id="long")
        yield CountingWidget("foot", id="foot")
        yield CountingWidget("over\nand\nover", id="over")


def pieces(update: Any) -> dict[tuple[int, int], list[tuple[str, Any]]]:
    """The segments drawn in the spans of an update, by line and column."""
    assert isinstance(update, ChopsUpdate)
    found = {}
    for y, begin, end in update.spans:
        for (x, strip), until in zip(update.chops[y].items(), update.chop_ends[y], strict=True):
            if x < end and until > begin:
                assert strip is not None
                found[y, x] = [(each.text, each.style) for each in strip.simplify()]
    return found


def both(compositor: Any, *regions: Region) -> tuple[Any, Any]:
    """The update for these regions from our compositor, and from Textual's."""
    compositor._dirty_regions.update(regions)
    ours = pieces(compositor.render_partial_update())
    compositor._dirty_regions.update(regions)
    return ours, pieces(Compositor.render_partial_update(compositor))


@pytest.mark.parametrize(
    "seed",
    [pytest.param(0, marks=pytest.mark.slow), *(pytest.param(each, marks=pytest.mark.soak) for each in range(1, 4))],
)
def test_changed_parts_are_composed_as_in_textual(seed: int) -> None:
    async def main() -> None:
        draw = random.Random(seed)
        app = Panes()
        async with app.run_test(size=(WIDTH, HEIGHT)) as pilot:
            for _ in range(40):
                app.query_one(VerticalScroll).scroll_to(y=draw.randrange(20), animate=False)
                app.query_one("#over").styles.offset = (draw.randrange(-5, 36), draw.randrange(-2, 11))
                await pilot.pause()
                regions = []
                for _ in range(draw.randint(1, 4)):
                    x, y = draw.randrange(WIDTH), draw.randrange(HEIGHT)
                    regions.append(Region(x, y, draw.randint(1, WIDTH - x), draw.randint(1, HEIGHT - y)))
                ours, theirs = both(app.screen._compositor, *regions)
                assert ours == theirs

    asyncio.run(main())


def test_only_lines_that_are_drawn_are_rendered() -> None:
    async def main() -> None:
        app = Panes()
        async with app.run_test(size=(WIDTH, HEIGHT)) as pilot:
            await pilot.pause()
            left, long, foot, over = (
                app.query_one(f"#{each}", CountingWidget) for each in ("left", "long", "foot", "over")
            )
            compositor: Any = app.screen._compositor
            left.asked = long.asked = foot.asked = over.asked = 0
            first, last = Region(1, 1, 4, 1), Region(0, HEIGHT - 1, WIDTH, 1)
            compositor._dirty_regions.update([first, last])
            compositor.render_partial_update()
            assert (left.asked, long.asked, foot.asked, over.asked) == (1, 0, 1, 0)

            compositor._dirty_regions.add(Region(14, 4, 11, 3))
            compositor.render_partial_update()
            assert over.asked == 3
            assert (left.asked, long.asked) == (1, 0), "they lie beneath"

    asyncio.run(main())


def test_nothing_is_drawn_if_nothing_changed() -> None:
    async def main() -> None:
        app = Panes()
        async with app.run_test(size=(WIDTH, HEIGHT)) as pilot:
            await pilot.pause()
            compositor: Any = app.screen._compositor
            compositor._dirty_regions.clear()
            assert compositor.render_partial_update() is None

    asyncio.run(main())


@pytest.mark.parametrize("drawn_before", [False, True])
def test_the_layout_notices_a_widget_that_is_shown_even_if_something_was_drawn_before(drawn_before: bool) -> None:
    async def play() -> None:
        app = Panes()
        async with app.run_test(size=(WIDTH, HEIGHT)) as pilot:
            foot, panes = app.query_one("#foot"), app.query_one("Horizontal")
            foot.display = False
            await pilot.pause()
            compositor = app.screen._compositor
            compositor.render_full_update()
            foot.display = True
            if drawn_before:
                compositor.update_widgets({foot})
                assert foot in compositor.full_map
            found = compositor.reflow(app.screen, app.size)
            assert foot in found.shown and panes in found.resized, "both are told their sizes"
            assert any(each.overlaps(panes.region) for each in compositor._dirty_regions), "and both are drawn"

    asyncio.run(play())
