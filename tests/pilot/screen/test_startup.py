"""A console that shows its frame first: keys typed before the panes exist, and the final state of the screen."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from typing import cast

import pytest
from bot_console.tui.app import BotConsoleApp
from bot_console.tui.arrangement import startup
from bot_console.tui.arrangement.rqt_command_line import Opening
from bot_console.tui.arrangement.startup import ORDERED, StartupSequence, System
from bot_console.tui.layout.built_in import BUILT_IN, OVERVIEW
from bot_console.tui.layout.tree import panes
from bot_console.tui.pane_table import PaneEntry
from bot_console.tui.panes.broken_pane import BrokenPane
from bot_console.tui.panes.plot.pane import PlotPane
from bot_console.tui.screens.picker import PickerScreen
from bot_console.tui.terminal.frame_pacing import AnswerGate
from bot_console.tui.terminal.visible_screen import mount_unseen
from bot_console.tui.widgets.command_line import CommandField
from bot_console.tui.widgets.pane_area import PanePlaceholder
from bot_console.tui.widgets.row_list import RowList
from fakes.command_line import FakeCommandLine
from piloting import Session, run
from rest import at_rest
from samples import live
from textual import events
from textual.widget import Widget
from textual.widgets import Input

SIZE = (120, 40)
SEEN_FIRST = len(panes(BUILT_IN[OVERVIEW].form(*SIZE)))
"""The number of panes in the overview at this size."""
NAMES = {"!": "exclamation_mark", ":": "colon", "?": "question_mark"}


def arrive(typed: str, play: Callable[[Session], Awaitable[None]], panes: int = len(ORDERED)) -> None:
    """Run an app that gets its system late, with keys typed at the very moment when the app asks for it.

    `play` begins when `panes` panes exist.
    """

    async def main() -> None:
        console, launcher = live()

        def reach() -> System:
            assert app.query(PanePlaceholder) and not app.query("Pane")
            for character in typed:
                app.post_message(events.Key(NAMES.get(character, character), character))
            return System(console, FakeCommandLine(console.asked))

        app = BotConsoleApp(reach=reach, refresh_hz=0)
        with at_rest(is_scripted=True):
            async with app.run_test(size=SIZE, notifications=True) as pilot:
                while not app.current_pane or len(app.query("Pane")) < panes:
                    await pilot.pause()
                session = Session(app, pilot, console, launcher)
                await session.settle()
                await play(session)

    asyncio.run(main())


def test_first_frame_shows_the_keys_of_the_pane_that_opens_first() -> None:
    async def main() -> None:
        lines: list[str] = []

        def reach() -> System:
            lines.extend(strip.text for strip in app.screen._compositor.render_strips())
            console, _ = live()
            return System(console, FakeCommandLine(console.asked))

        app = BotConsoleApp(reach=reach, refresh_hz=0, opening=Opening(pane="steering"))
        with at_rest(is_scripted=True):
            async with app.run_test(size=SIZE) as pilot:
                while not app.query("#images"):
                    await pilot.pause()
        assert "Steering" in lines[1] and "enter Arm" in lines[-1]

    asyncio.run(main())


def test_panes_made_one_by_one_finally_look_like_panes_made_at_once() -> None:
    seen: list[str] = []

    async def poll(session: Session) -> None:
        assert [each.id for each in session.app.panes()] == [each.id for each in ORDERED]
        assert not session.app.query(PanePlaceholder) and not session.app.query("#coming-status")
        seen.append(session.text())
        await session.press("tab", "7")
        seen.append(session.text())

    arrive("", poll)
    run(live(), poll, SIZE)
    assert seen[:2] == seen[2:]


def test_first_frame_has_tabs_keys_and_the_positions_of_the_panes(monkeypatch: pytest.MonkeyPatch) -> None:
    async def never(sequence: StartupSequence) -> None:
        return

    monkeypatch.setattr(StartupSequence, "run_next_step", never)

    async def main() -> None:
        app = BotConsoleApp(reach=lambda: System(live()[0]), refresh_hz=0)
        with at_rest(is_scripted=True):
            async with app.run_test(size=SIZE) as pilot:
                await pilot.pause()
                text = "\n".join(strip.text for strip in app.screen._compositor.render_strips())
                assert all(word in text for word in ("0 All", "Parameters", "World", "Plot", "Logs", "! Stop"))
                await pilot.press("exclamation_mark", "q", "ctrl+z")
                assert app.is_running and app._keyboard._waiting, "keys that need a console wait for it"
                await pilot.press("ctrl+c")
                assert not app.screen.is_attached, "quitting does not wait"

    asyncio.run(main())


def test_keys_typed_before_the_panes_exist_act_on_them_in_order() -> None:
    async def play(session: Session) -> None:
        field = session.pane(CommandField)
        assert session.app.current_pane is not None and session.app.current_pane.id == "logs"
        assert field.is_open and field.query_one(Input).value == "ros!"
        assert ("all_stop", True) not in session.console.asked

    arrive("2:ros!", play)


@pytest.mark.slow
def test_keys_for_a_pane_wait_until_it_exists() -> None:
    async def play(session: Session) -> None:
        assert session.pane(PlotPane).display
        assert isinstance(session.app.screen, PickerScreen)
        assert session.app.screen.query_one(Input).value == "a!b"
        assert ("all_stop", True) not in session.console.asked

    arrive("4aa!b", play)


def test_a_stop_typed_first_waits_for_no_pane(monkeypatch: pytest.MonkeyPatch) -> None:
    panes_then: list[int] = []
    act = BotConsoleApp.action_all_stop

    def stop(app: BotConsoleApp) -> None:
        panes_then.append(len(app.query("Pane")))
        act(app)

    monkeypatch.setattr(BotConsoleApp, "action_all_stop", stop)

    async def play(session: Session) -> None:
        assert panes_then == [0] and ("all_stop", True) in session.console.asked
        assert session.app.current_pane is not None and session.app.current_pane.id == "launch"

    arrive("!8", play)


@pytest.mark.parametrize(
    ("key", "action", "hidden"),
    [
        ("6", "pane", 1),
        *(
            pytest.param(*each, marks=pytest.mark.slow)
            for each in (
                ("?", "help", 0),
                ("j", "", 1),
                ("2", "pane", 0),
                ("I", "pane", 1),
                (":", "command_line", None),
            )
        ),
    ],
)
def test_a_key_waits_only_for_the_panes_that_it_is_for(
    key: str, action: str, hidden: int | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    there: list[int] = []
    owner, name = (BotConsoleApp, f"action_{action}") if action else (RowList, "action_cursor")
    act = getattr(owner, name)

    def noted(self: Widget, *given: object) -> object:
        there.append(len(app_of(self).query("Pane")))
        return act(self, *given)

    monkeypatch.setattr(owner, name, noted)

    async def play(session: Session) -> None:
        least, maximum = (len(ORDERED),) * 2 if hidden is None else (SEEN_FIRST, SEEN_FIRST + hidden)
        assert len(there) == 1 and least <= there[0] <= maximum  # a pane gets the focus a moment after it was mounted
        assert [each.id for each in session.app.panes()] == [each.id for each in ORDERED]
        if key in ("6", "I"):
            assert session.app.current_pane is not None and session.app.current_pane.display

    arrive(key, play)


def count_hidden_mounts(monkeypatch: pytest.MonkeyPatch, asked: Callable[[], bool]) -> list[int]:
    """Let `asked` decide whether a key was just pressed; return the number of hidden panes made, at each call."""
    came: list[int] = []

    def is_eager(gate: AnswerGate) -> bool:
        came.append(came[-1] if came else 0)
        return asked()

    async def mount(parent: Widget, widget: Widget, before: Widget | None) -> None:
        came.append((came[-1] if came else 0) + 1)
        await mount_unseen(parent, widget, before)

    monkeypatch.setattr(AnswerGate, "is_eager", property(is_eager))
    monkeypatch.setattr(startup, "mount_unseen", mount)
    return came


def test_hidden_panes_are_made_while_no_key_is_pressed(monkeypatch: pytest.MonkeyPatch) -> None:
    pressed = iter([True] * 5)
    came = count_hidden_mounts(monkeypatch, lambda: next(pressed, False))

    async def play(session: Session) -> None:
        assert came[:5] == [0] * 5 and len(session.app.panes()) == len(ORDERED)

    arrive("?", play)


@pytest.mark.slow
def test_hidden_panes_are_made_even_if_keys_are_pressed_all_the_time(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(startup, "MAX_HIDDEN_PANE_PAUSE_S", 0.1)
    count_hidden_mounts(monkeypatch, lambda: True)

    async def play(session: Session) -> None:
        assert len(session.app.panes()) == len(ORDERED)

    arrive("?", play)


def test_a_pane_that_a_key_is_for_is_made_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(startup, "MAX_HIDDEN_PANE_PAUSE_S", float("inf"))
    came = count_hidden_mounts(monkeypatch, lambda: True)

    async def play(session: Session) -> None:
        assert session.app.current_pane is not None and session.app.current_pane.id == "images" and max(came) == 1

    arrive("I", play, SEEN_FIRST + 1)


def app_of(node: Widget | BotConsoleApp) -> BotConsoleApp:
    return node if isinstance(node, BotConsoleApp) else cast(BotConsoleApp, node.app)


def test_a_pane_that_cannot_be_made_does_not_affect_others(monkeypatch: pytest.MonkeyPatch) -> None:
    load = PaneEntry.load

    def fails(entry: PaneEntry) -> object:
        if entry.id in ("world", "history"):
            raise ImportError("no such thing")
        return load(entry)

    monkeypatch.setattr(PaneEntry, "load", fails)

    async def play(session: Session) -> None:
        assert {each.id for each in session.app.query(BrokenPane)} == {"world", "history"}
        assert "no such thing" in session.text()
        assert len(session.app.panes()) == len(ORDERED)

    arrive("", play)
