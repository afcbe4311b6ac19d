"""A hidden widget is neither laid out nor drawn, and is complete when it is shown."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable

import pytest
from bot_console.tui.terminal.visible_screen import VisibleScreen, mount_unseen
from sampling import slow_after
from textual.app import App, ComposeResult
from textual.containers import Container, Horizontal
from textual.geometry import Size
from textual.pilot import Pilot
from textual.screen import Screen
from textual.widgets import Static


class Panes(App[None]):
    """Two panes, the second of them hidden, on a screen that counts how often it is laid out and drawn."""

    CSS = "Container { width: 1fr; } Static { height: auto; }"

    def __init__(self, kind: type[Screen[None]]) -> None:
        super().__init__()
        self._kind = kind
        self.laid_out = self.drawn = 0

    def get_default_screen(self) -> Screen[None]:
        """The counting screen."""
        app = self

        class Counting(self._kind):
            def _refresh_layout(self, size: Size | None = None, scroll: bool = False) -> None:
                app.laid_out += 1
                super()._refresh_layout(size, scroll)

            def _compositor_refresh(self) -> None:
                app.drawn += 1
                super()._compositor_refresh()

        return Counting()

    def compose(self) -> ComposeResult:
        with Horizontal():
            with Container(id="shown"):
                yield Static("shown")
            with Container(id="hidden") as hidden:
                hidden.display = False
                yield Static("a")

    def lines(self) -> list[str]:
        """The lines on the screen."""
        return [strip.text for strip in self.screen._compositor.render_strips()]


Play = Callable[[Panes, Pilot[None]], Awaitable[None]]


def run_play(play: Play, kind: type[Screen[None]] = VisibleScreen) -> tuple[int, int, list[str]]:
    """How often a play has the screen laid out and drawn, and the lines at its end."""

    async def main() -> tuple[int, int, list[str]]:
        app = Panes(kind)
        async with app.run_test(size=(40, 6)) as pilot:
            await pilot.pause()
            before = app.laid_out, app.drawn
            await play(app, pilot)
            await pilot.pause()
            return app.laid_out - before[0], app.drawn - before[1], app.lines()

    return asyncio.run(main())


async def grow(app: Panes, pilot: Pilot[None]) -> None:
    app.query_one("#hidden Static", Static).update("b\nc")
    await app.query_one("#hidden").mount(Static("d"))
    await pilot.pause()


async def come(app: Panes, pilot: Pilot[None]) -> None:
    new = Container(Static("new"), id="new")
    new.display = False
    await mount_unseen(app.query_one(Horizontal), new, app.query_one("#hidden"))
    await pilot.pause()


@pytest.mark.parametrize("change", [grow, come])
def test_hidden_changes_are_neither_laid_out_nor_drawn(change: Play) -> None:
    assert run_play(change)[:2] == (0, 0)
    if change is grow:
        assert run_play(change, Screen)[0] > 0, "as Textual does"


async def grow_and_show(app: Panes, pilot: Pilot[None]) -> None:
    await grow(app, pilot)
    app.query_one("#hidden").display = True


async def show_and_hide(app: Panes, pilot: Pilot[None]) -> None:
    await grow_and_show(app, pilot)
    await pilot.pause()
    app.query_one("#hidden").display = False


async def hide_all(app: Panes, pilot: Pilot[None]) -> None:
    app.query_one(Horizontal).display = False
    await pilot.pause()
    await grow(app, pilot)


async def hide_the_other(app: Panes, pilot: Pilot[None]) -> None:
    await grow_and_show(app, pilot)
    app.query_one("#shown").display = False


async def grow_before_the_hidden(app: Panes, pilot: Pilot[None]) -> None:
    shown = app.query_one("#shown Static", Static)
    shown.update("b\nc")
    shown._check_refresh()
    hidden = app.query_one("#hidden")
    hidden.refresh(layout=True)
    hidden._check_refresh()


async def come_and_show(app: Panes, pilot: Pilot[None]) -> None:
    await come(app, pilot)
    app.query_one("#new").display = True
    assert [each.id for each in app.query_one(Horizontal).children] == ["shown", "new", "hidden"]


@pytest.mark.parametrize(
    "change",
    [grow_and_show, hide_the_other, *slow_after(0, [show_and_hide, hide_all, grow_before_the_hidden, come_and_show])],
)
def test_final_screen_equals_that_of_textual(change: Play) -> None:
    assert run_play(change)[2] == run_play(change, Screen)[2]
