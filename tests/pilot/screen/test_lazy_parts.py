"""Panes compose their parts when they are first shown, and then look as if they had done so from the start."""

from __future__ import annotations

import asyncio

import pytest
from bot_console.tui.arrangement.startup import ORDERED
from bot_console.tui.panes.alarms.pane import AlarmsPane
from bot_console.tui.panes.broken_pane import BrokenPane
from bot_console.tui.panes.pane import Pane
from bot_console.tui.panes.profiles.pane import ProfilesPane
from bot_console.tui.panes.topics.pane import TopicsPane
from bot_console.tui.panes.topics.table import TopicRows
from bot_console.tui.widgets.lazy_parts import LazyParts
from piloting import Session, run
from samples import live
from textual.app import App, ComposeResult
from textual.widgets import Static

DIGITS = {each.id: each.key for each in ORDERED}


def test_pane_composes_nothing_before_it_is_shown() -> None:
    async def play(session: Session) -> None:
        panes = {each.id: each for each in session.app.panes()}
        assert [*panes] == [each.id for each in ORDERED]
        seen = ["parameters", "world", "plot", "logs"]
        assert [id for id, each in panes.items() if each.has_parts] == seen
        await session.press("9")
        assert [id for id, each in panes.items() if each.has_parts] == [*seen, "topics"]
        assert not any(each.is_ending for each in panes.values())

    run(live(), play)


@pytest.mark.parametrize("digits", ["9", pytest.param("12345678HMBI", marks=pytest.mark.slow)])
def test_lazily_composed_panes_look_like_eager_ones(digits: str, monkeypatch: pytest.MonkeyPatch) -> None:
    assert {*digits} < {*DIGITS.values()}
    seen: list[list[str]] = [[], []]

    async def play(session: Session) -> None:
        for digit in digits:
            await session.press(digit)
            seen[0].append(session.text())

    run(live(), play, (120, 40))
    seen.reverse()
    monkeypatch.setattr(LazyParts, "come_late", lambda self: None)
    run(live(), play, (120, 40))
    assert seen[0] == seen[1]


def test_query_on_a_pane_composes_all_its_parts() -> None:
    async def play(session: Session) -> None:
        pane = session.pane(TopicsPane)
        assert not pane.has_parts
        assert pane.query_one("#topics-message").is_attached and pane.query(TopicRows)
        await session.press("9")
        assert len(pane.query(TopicRows)) == 1, "they are made once"

    run(live(), play)


class Box(LazyParts):
    def compose(self) -> ComposeResult:
        yield Static(id="part")


def test_parts_requested_during_mount_are_composed_once() -> None:
    async def play() -> None:
        app: App[None] = App()
        async with app.run_test() as pilot:
            box = Box()
            box.come_late()
            mounted = app.mount(box)
            box.make_parts()
            await mounted
            await pilot.pause()
            assert len(box.children) == 1

    asyncio.run(play())


def test_exception_in_lazy_composition_ends_only_that_pane(monkeypatch: pytest.MonkeyPatch) -> None:
    def compose(self: Pane) -> ComposeResult:
        raise ValueError("no parts")
        yield

    monkeypatch.setattr(ProfilesPane, "compose", compose)

    async def play(session: Session) -> None:
        assert session.app.controls.faults.seen == []
        await session.press("7")
        assert [str(each) for each in session.app.controls.faults.seen] == ["no parts"]
        broken = session.pane(BrokenPane)
        assert broken.id == "profiles" and broken.display and "no parts" in session.text()
        await session.press("B")
        assert session.pane(AlarmsPane).display and session.pane(AlarmsPane).has_parts

    run(live(), play, faults_wanted=True)
