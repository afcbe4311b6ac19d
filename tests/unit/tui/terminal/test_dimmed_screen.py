"""The panes around a box are drawn as Textual draws them, and fewer lines are rendered."""

from __future__ import annotations

import asyncio
from typing import Any

import pytest
from bot_console.tui.terminal.dimmed_screen import DimmedScreen
from bot_console.tui.terminal.output import HoldingScreen
from rich.style import Style
from rich.text import Text
from sampling import slow_after
from textual._compositor import Compositor
from textual.app import App, ComposeResult
from textual.containers import Container, Horizontal
from textual.geometry import Region
from textual.screen import ModalScreen, Screen
from textual.strip import Strip
from textual.widgets import Static

SIZE = (40, 12)


class RecordingWidget(Static):
    """Records the lines that are requested of it."""

    asked: list[int]

    def render_lines(self, crop: Region) -> list[Strip]:
        self.asked = [*getattr(self, "asked", []), *crop.line_range]
        return super().render_lines(crop)


class Box(DimmedScreen):
    """A box in the middle."""

    def __init__(self, word: str) -> None:
        super().__init__()
        self._word = word

    def compose(self) -> ComposeResult:
        yield RecordingWidget(self._word, classes="box")


class Panes(App[None]):
    """Frames beside each other, with colours, a link and characters of two cells."""

    CSS = """
    Container { width: 1fr; height: 1fr; border: round green; background: $panel; }
    Box { align: center middle; background: $background 60%; }
    Box.clear { background: $background 0%; }
    Box.opaque { background: $background; }
    .box { width: 20; height: 4; border: round red; background: blue; }
    """

    def get_default_screen(self) -> Screen[Any]:
        return HoldingScreen()

    def compose(self) -> ComposeResult:
        text = Text("one 漢字\ntwo", style="bold yellow")
        text.append("\nthree", Style(color="red", meta={"a": 1}, link="file:///x"))
        with Horizontal():
            yield Container(RecordingWidget(text, id="left"))
            yield Container(RecordingWidget("\n".join(f"line {each}" for each in range(20)), id="right"))


def drawn_cells(update: Any) -> list[list[tuple[str, Style | None]]]:
    """Each cell of each line of an update, with its style but without the random ids of links."""
    return [
        [(character, each.style and each.style.clear_meta_and_links()) for each in strip for character in each.text]
        for strip in (Strip.join(line) for line in update.strips)
    ]


def links(update: Any) -> bool:
    """Whether anything that is drawn is a link."""
    return any(each.style and each.style.link for line in update.strips for strip in line for each in strip)


@pytest.mark.parametrize("names", slow_after(2, [[""], ["", "clear"], ["opaque"], ["clear"], ["", ""], ["opaque", ""]]))
@pytest.mark.parametrize("colours", [True, False])
def test_screen_below_is_dimmed_as_in_textual(names: list[str], colours: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    if not colours:
        monkeypatch.setenv("NO_COLOR", "1")

    async def main() -> None:
        app = Panes()
        async with app.run_test(size=SIZE) as pilot:
            for number, name in enumerate(names):
                box = Box(f"box {number}")
                box.set_class(bool(name), name or "none")
                await app.push_screen(box)
            await pilot.pause()
            screen: Any = app.screen
            ours = screen._compositor.render_update(full=True, screen_stack=app._background_screens)
            with monkeypatch.context() as textual:
                for name in ("render_lines", "render_line"):
                    textual.setattr(DimmedScreen, name, getattr(ModalScreen, name), raising=False)
                for each in app.screen_stack:
                    compositor: Any = each._compositor
                    compositor.__class__ = Compositor
                    each.refresh()
                    each._styles_cache.clear()
                    each._dirty_regions.add(each.size.region)
                theirs = screen._compositor.render_update(full=True, screen_stack=app._background_screens)
            assert drawn_cells(ours) == drawn_cells(theirs)
            assert not links(ours)

    asyncio.run(main())


def test_only_lines_that_are_drawn_are_rendered() -> None:
    async def main() -> None:
        app = Panes()
        async with app.run_test(size=SIZE) as pilot:
            left, right = (app.query_one(f"#{each}", RecordingWidget) for each in ("left", "right"))
            await app.push_screen(Box("box"))
            await pilot.pause()
            left.asked, right.asked = [], []
            compositor: Any = app.screen._compositor
            compositor._dirty_regions.update([Region(0, 3, 40, 1)])
            compositor.render_partial_update()
            assert (left.asked, right.asked) == ([2], [2])
            compositor._dirty_regions.update([Region(12, 5, 10, 1)])
            compositor.render_partial_update()
            assert (left.asked, right.asked) == ([2], [2]), "they lie beneath the box"

    asyncio.run(main())


def test_dismissing_a_screen_twice_closes_no_other_screen() -> None:
    async def main() -> None:
        app = Panes()
        async with app.run_test(size=SIZE) as pilot:
            below, above = Box("below"), Box("above")
            app.push_screen(below)
            app.push_screen(above)
            await pilot.pause()
            above.dismiss()
            above.dismiss()
            await pilot.pause()
            assert app.screen is below
            below.dismiss()
            below.dismiss()
            await pilot.pause()
            assert len(app.screen_stack) == 1 and app._exception is None

    asyncio.run(main())


def test_screen_dismissed_behind_another_closes_once_that_one_has_closed() -> None:
    async def main() -> None:
        app = Panes()
        async with app.run_test(size=SIZE) as pilot:
            below, above = Box("below"), Box("above")
            app.push_screen(below)
            app.push_screen(above)
            await pilot.pause()
            below.dismiss()
            await pilot.pause()
            assert app.screen is above
            above.dismiss()
            await pilot.pause()
            await pilot.pause()
            assert len(app.screen_stack) == 1

    asyncio.run(main())
