"""After every frame the terminal shows what Textual has composed; no frame is sent while it is busy."""

from __future__ import annotations

import asyncio
import random
from collections.abc import Awaitable, Callable
from typing import Any

import pytest
from bot_console.tui.terminal.frame_pacing import AnswerGate
from bot_console.tui.terminal.output import QUESTION, SparingApp
from emulator import Emulator
from textual import events
from textual.app import ComposeResult
from textual.containers import Container, Horizontal
from textual.drivers.headless_driver import HeadlessDriver
from textual.geometry import Region, Size
from textual.pilot import Pilot
from textual.screen import ModalScreen
from textual.widgets import Static

WIDTH, HEIGHT = 40, 8


class FakeGate(AnswerGate):
    """A gate that the test opens and closes."""

    closed = False

    def wait(self) -> float:
        return 3600.0 if self.closed else 0.0


class Wire(HeadlessDriver):
    """The connection to the test's terminal."""

    is_headless = False

    def write(self, data: str) -> None:
        app: Any = self._app
        app.terminal.feed(data)
        if QUESTION in data:
            app.frames.append(data)
            self.process_message(events.CursorPosition(0, 0))


class OverlayScreen(ModalScreen[None]):
    """A screen over the panes."""

    CSS = "OverlayScreen { align: center middle; } OverlayScreen Static { width: 12; height: 3; border: round white; }"

    def compose(self) -> ComposeResult:
        yield Static("over")
        yield Static("more")


class Panes(SparingApp):
    """Two framed panes beside each other, so that a line holds parts of both."""

    CSS = "Container { width: 1fr; border: round white; } Static { height: 3; }"

    def __init__(self) -> None:
        super().__init__()
        self.driver_class = Wire
        self.gate: FakeGate = FakeGate()
        self.terminal = Emulator(WIDTH, HEIGHT)
        self.frames: list[str] = []

    def compose(self) -> ComposeResult:
        with Horizontal():
            yield Container(Static("one\ntwo\nthree", id="left"))
            yield Container(Static("red\ngreen\nblue", id="right"))

    def write(self, side: str, text: str) -> None:
        self.query_one(f"#{side}", Static).update(text, layout=False)

    def composed(self) -> list[str]:
        """The lines that stock Textual would draw now."""
        return [strip.text for strip in self.screen._compositor.render_strips()]


def run(script: Callable[[Panes, Pilot[None]], Awaitable[None]]) -> None:
    """Run the app in a terminal, and the script on it."""

    async def whole() -> None:
        app = Panes()
        outcome: list[BaseException] = []

        async def pilot(pilot: Pilot[Any]) -> None:
            try:
                await pilot.pause()
                await script(app, pilot)
            except BaseException as error:
                outcome.append(error)
                raise
            finally:
                app.exit()

        await app.run_async(size=(WIDTH, HEIGHT), auto_pilot=pilot)
        if outcome:
            raise outcome[0]

    asyncio.run(whole())


def test_a_pane_beside_a_changed_one_stays() -> None:
    async def script(app: Panes, pilot: Pilot[None]) -> None:
        for side, text in (("right", "cyan\ngreen\nblue"), ("left", "four"), ("right", "a\nb\nc"), ("left", "5\n6\n7")):
            app.write(side, text)
            await pilot.pause()
            assert app.terminal.lines() == app.composed()

    run(script)


def test_two_spans_of_one_line_are_both_drawn() -> None:
    async def script(app: Panes, pilot: Pilot[None]) -> None:
        app.write("left", "four\nfive\nsix")
        app.write("right", "cyan\nmagenta\nyellow")
        await pilot.pause()
        assert app.terminal.lines() == app.composed()
        assert "five" in app.terminal.lines()[2] and "magenta" in app.terminal.lines()[2]

    run(script)


def test_only_the_requested_part_of_a_widget_need_be_sent() -> None:
    async def script(app: Panes, pilot: Pilot[None]) -> None:
        app.query_one("#left").refresh(Region(0, 1, 2, 1))
        before = len(app.frames)
        await pilot.pause()
        assert app.terminal.lines() == app.composed()
        assert len(app.frames) == before, "nothing has changed, so nothing is sent"

    run(script)


def test_screen_over_the_panes_is_drawn_and_removed() -> None:
    async def script(app: Panes, pilot: Pilot[None]) -> None:
        await app.push_screen(OverlayScreen())
        await pilot.pause()
        assert app.terminal.lines() == app.composed()
        assert "over" in "".join(app.terminal.lines())
        app.pop_screen()
        await pilot.pause()
        assert app.terminal.lines() == app.composed()
        assert "over" not in "".join(app.terminal.lines())

    run(script)


@pytest.mark.parametrize("screens", [1, 2, pytest.param(3, marks=pytest.mark.slow)])
def test_panes_keep_updating_below_stacked_screens(screens: int) -> None:
    async def script(app: Panes, pilot: Pilot[None]) -> None:
        for _ in range(screens):
            await app.push_screen(OverlayScreen())
            await pilot.pause()
        for number in range(3):
            app.screen_stack[0].query_one("#left", Static).update(f"\nnumber {number}", layout=False)
            await pilot.pause()
            await pilot.pause()
            assert f"number {number}" in "".join(app.terminal.lines())

    run(script)


def test_a_new_size_is_drawn_whole() -> None:
    async def script(app: Panes, pilot: Pilot[None]) -> None:
        for width, height in ((20, 5), (60, 12), (1, 1), (WIDTH, HEIGHT)):
            app.terminal = Emulator(width, height)
            app._driver._size = (width, height)
            size = Size(width, height)
            app.post_message(events.Resize(size, size))
            await pilot.pause()
            await pilot.pause()
            assert app.terminal.lines() == app.composed()

    run(script)


@pytest.mark.parametrize("changes", [1, 50])
def test_while_the_terminal_is_busy_frames_merge_into_one(changes: int) -> None:
    async def script(app: Panes, pilot: Pilot[None]) -> None:
        app.gate.closed = True
        before = len(app.frames)
        for number in range(changes):
            app.write("left", f"number {number}")
            await pilot.pause()
        assert len(app.frames) == before
        app.gate.closed = False
        app._draw_held()
        assert len(app.frames) == before + 1
        assert f"number {changes - 1}" in app.terminal.lines()[1]
        assert app.terminal.lines() == app.composed()

    run(script)


def test_a_layout_while_the_terminal_is_busy_is_not_lost() -> None:
    async def script(app: Panes, pilot: Pilot[None]) -> None:
        app.gate.closed = True
        app.query_one("#left").styles.height = 1
        await app.query_one("#right").remove()
        await pilot.pause()
        app.gate.closed = False
        app._draw_held()
        await pilot.pause()
        assert app.terminal.lines() == app.composed()
        assert "green" not in "".join(app.terminal.lines())

    run(script)


@pytest.mark.parametrize("over", [False, True])
def test_change_just_before_a_held_frame_is_drawn_is_not_lost(over: bool) -> None:
    async def script(app: Panes, pilot: Pilot[None]) -> None:
        if over:
            await app.push_screen(OverlayScreen())
            await pilot.pause()
        first, second = list(app.screen.query(Static))[:2]
        app.gate.closed = True
        first.update("held", layout=False)
        await pilot.pause()
        second.update("late", layout=False)
        for _ in range(100):  # Textual has noticed the change, but not processed it yet
            if second not in app.screen._dirty_widgets:
                await asyncio.sleep(0)
        app.gate.closed = False
        app._draw_held()
        await pilot.pause()
        shown = "".join(app.terminal.lines())
        assert "held" in shown and "late" in shown

    run(script)


@pytest.mark.parametrize(
    "seed",
    [0, pytest.param(1, marks=pytest.mark.slow), *(pytest.param(each, marks=pytest.mark.soak) for each in range(2, 6))],
)
def test_random_changes_while_frames_are_held_end_in_the_drawn_screen(seed: int) -> None:
    draw = random.Random(seed)

    async def change(app: Panes) -> None:
        side = draw.choice(("left", "right"))
        what = draw.choice(("text", "text", "text", "layout", "part", "over", "redraw"))
        if what == "text":
            app.screen_stack[0].query_one(f"#{side}", Static).update(
                str(draw.random()) * draw.randint(1, 5), layout=False
            )
        elif what == "layout":
            app.screen_stack[0].query_one(f"#{side}").styles.height = draw.randint(1, 5)
        elif what == "part":
            app.screen_stack[0].query_one(f"#{side}").refresh(Region(1, 1, 3, 1))
        elif what == "over":
            await (app.pop_screen() if len(app.screen_stack) > 1 else app.push_screen(OverlayScreen()))
        else:
            app.redraw()

    async def script(app: Panes, pilot: Pilot[None]) -> None:
        for _ in range(40):
            await change(app)
            app.gate.closed = draw.random() < 0.5
            for _ in range(draw.randrange(4)):
                await asyncio.sleep(0)
            if draw.random() < 0.3:
                await pilot.pause()
            if not app.gate.closed:
                app._draw_held()
        app.gate.closed = False
        app._draw_held()
        await pilot.pause()
        app._draw_held()
        assert app.terminal.lines() == app.composed()

    run(script)
