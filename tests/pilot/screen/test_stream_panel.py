"""Continuous lines run in panels below the panes, do not take the keyboard, and end separately by their key."""

from __future__ import annotations

from collections.abc import Sequence

import pytest
from bot_console.tui.console.command_line import Stream
from bot_console.tui.widgets.streams.panels import StreamPanels, room
from fakes.command_line import FakeCommandLine
from piloting import Session, run
from samples import live


class FakeStream:
    """A stream that the test fills."""

    def __init__(self) -> None:
        self.reported: Sequence[str] = ()
        self.ended = self.stopped = False

    def lines(self) -> Sequence[str]:
        return self.reported

    def stop(self) -> None:
        self.stopped = True


SIZES = [(80, 24), pytest.param((120, 40), marks=pytest.mark.soak)]
"""The smaller size has the least room for panels."""


@pytest.fixture
def streams(monkeypatch: pytest.MonkeyPatch) -> list[FakeStream]:
    """The streams that were started."""
    begun: list[FakeStream] = []

    def stream(_: FakeCommandLine, line: str) -> Stream | None:
        if "hz" not in line:
            return None
        begun.append(FakeStream())
        return begun[-1]

    monkeypatch.setattr(FakeCommandLine, "stream", stream)
    return begun


async def begin(session: Session, line: str = "ros2 topic hz /odom", *, typed: bool = False) -> StreamPanels:
    """Run a continuous line as a pane does, or `typed` like a person, which takes longer."""
    if typed:
        await session.press(":")
        await session.paste(line)
        await session.press("enter")
    else:
        session.app.controls.commands.runner.run(line)
        await session.settle()
    return session.pane(StreamPanels)


@pytest.mark.parametrize("size", SIZES)
def test_panel_shows_the_last_lines_without_taking_focus(streams: list[FakeStream], size: tuple[int, int]) -> None:
    async def play(session: Session) -> None:
        focused = session.app.focused
        assert "runs" not in session.text()
        panel = await begin(session, typed=True)
        streams[0].reported = [f"[red]average rate: {number}[/red]" for number in range(50)]
        panel.poll()
        await session.settle()
        assert "ros2 topic hz /odom · runs · ^o closes" in session.text()
        assert "[red]average rate: 49[/red]" in session.text() and "rate: 43" not in session.text()
        assert session.app.focused is focused
        await session.press("2")
        assert "average rate: 49" in session.text(), "it stays in every pane"
        await session.press("ctrl+o")
        assert streams[0].stopped and "average rate" not in session.text()

    run(live(), play, size)


def test_commands_end_with_the_console(streams: list[FakeStream]) -> None:
    async def play(session: Session) -> None:
        await begin(session)
        assert not streams[0].stopped

    run(live(), play)
    assert streams[0].stopped


@pytest.mark.parametrize("size", SIZES)
def test_three_commands_run_side_by_side_and_end_separately(streams: list[FakeStream], size: tuple[int, int]) -> None:
    async def play(session: Session) -> None:
        focused = session.app.focused
        panels = session.pane(StreamPanels)
        for topic in ("/odom", "/scan", "/cmd_vel"):
            await begin(session, f"ros2 topic hz {topic}")
        for number, each in enumerate(streams):
            each.reported = [f"rate of number {number}"]
        panels.poll()
        await session.settle()
        for number in range(3):
            assert f"rate of number {number}" in session.text()
        assert "1 topic hz /odom" in session.text() and "3 topic hz /cmd_vel" in session.text()
        assert session.app.focused is focused
        await session.press("ctrl+o", "2", "enter")
        assert [each.stopped for each in streams] == [False, True, False]
        await session.settle()
        assert "rate of number 1" not in session.text() and "2 topic hz /cmd_vel" in session.text()
        await session.press("ctrl+o")
        await session.type("all")
        await session.press("enter")
        assert all(each.stopped for each in streams) and not panels.panels
        assert session.app.focused is focused

    run(live(), play, size)


@pytest.mark.parametrize("size", SIZES)
def test_panels_never_hide_status_line_or_key_bar(streams: list[FakeStream], size: tuple[int, int]) -> None:
    async def play(session: Session) -> None:
        below = session.text().splitlines()[-2:]
        panels = session.pane(StreamPanels)
        while len(streams) < room(session.app.size):
            await begin(session)
        text = session.text().splitlines()
        assert [line[:8] for line in text[-2:]] == [line[:8] for line in below]
        assert sum("topic hz" in line for line in text) >= 1
        panes = session.app.query_one("#panes").region
        assert panes.height >= (size[1] - 3) // 2
        assert panels.region.bottom == size[1] - 2 and panels.region.y == panes.bottom
        last = panels.panels[-1].region
        assert last.bottom == panels.region.bottom and last.height >= 5

    run(live(), play, size)


def test_command_without_room_is_refused_and_an_ended_one_makes_room(streams: list[FakeStream]) -> None:
    async def play(session: Session) -> None:
        has = room(session.app.size)
        panels = session.pane(StreamPanels)
        while len(streams) < has:
            await begin(session)
        await begin(session, typed=True)
        assert len(streams) == has and f"no room: {has} commands are running; ^o ends one" in session.text()
        await session.press("escape")
        streams[1].ended = True
        panels.poll()
        await begin(session, "topic hz /new")
        assert len(streams) == has + 1 and len(panels.panels) == has
        assert panels.panels[-1].line == "topic hz /new" and streams[1].stopped and not streams[0].stopped

    run(live(), play, (80, 24))


def test_smaller_terminal_shows_the_newest_panels_and_counts_the_others(streams: list[FakeStream]) -> None:
    async def play(session: Session) -> None:
        panels = session.pane(StreamPanels)
        while len(streams) < 4:
            await begin(session)
        await session.pilot.resize_terminal(60, 20)
        panels.poll()
        await session.settle()
        assert "2 more not shown" in session.text() and "3 topic hz" in session.text()
        assert "1 topic hz" not in session.text() and not any(each.stopped for each in streams)

    run(live(), play, (80, 24))


def test_end_is_shown_and_click_on_the_title_closes(streams: list[FakeStream]) -> None:
    async def play(session: Session) -> None:
        await begin(session)
        panels = await begin(session)
        streams[1].ended = True
        panels.poll()
        await session.settle()
        assert "runs · ^o" in session.text() and "has ended · ^o" in session.text()
        await session.pilot.click(panels.panels[0], offset=(5, 2))
        assert len(panels.panels) == 2
        await session.pilot.click(panels.panels[0], offset=(5, 0))
        assert [each.stopped for each in streams] == [True, False] and len(panels.panels) == 1
        await session.press("ctrl+o")
        assert not panels.panels

    run(live(), play, (120, 40))


@pytest.mark.slow
def test_command_that_ends_shows_its_output(streams: list[FakeStream]) -> None:
    async def play(session: Session) -> None:
        await session.press(":")
        await session.paste("ros2 node list")
        await session.press("enter")
        assert not streams and "/robot_navigator" in session.text()

    run(live(), play, (120, 40))
