"""A line that goes on stands below the panes, takes no keyboard, and ends by its key."""

from __future__ import annotations

from collections.abc import Sequence

import pytest
from bot_console.tui.console.protocol import Stream
from bot_console.tui.widgets.stream_panel import StreamPanel
from fakes.command_line import FakeCommandLine
from piloting import Session, run
from samples import live


class Printing:
    """A stream that a test fills."""

    def __init__(self) -> None:
        self.told: Sequence[str] = ()
        self.ended = self.stopped = False

    def lines(self) -> Sequence[str]:
        return self.told

    def stop(self) -> None:
        self.stopped = True


@pytest.fixture
def streams(monkeypatch: pytest.MonkeyPatch) -> list[Printing]:
    """The streams that were begun."""
    begun: list[Printing] = []

    def stream(_: FakeCommandLine, line: str) -> Stream | None:
        if "hz" not in line:
            return None
        begun.append(Printing())
        return begun[-1]

    monkeypatch.setattr(FakeCommandLine, "stream", stream)
    return begun


async def begin(session: Session) -> StreamPanel:
    """Type a line that goes on."""
    await session.press(":")
    await session.type("ros2 topic hz /odom")
    await session.press("enter")
    return session.pane(StreamPanel)


@pytest.mark.parametrize("size", [(80, 24), (120, 40)])
def test_it_shows_the_last_lines_and_leaves_the_keyboard_where_it_was(
    streams: list[Printing], size: tuple[int, int]
) -> None:
    async def play(session: Session) -> None:
        focused = session.app.focused
        assert "runs" not in session.text()
        panel = await begin(session)
        streams[0].told = [f"[red]average rate: {number}[/red]" for number in range(50)]
        panel.look()
        await session.settle()
        assert "ros2 topic hz /odom · runs · ^o closes" in session.text()
        assert "[red]average rate: 49[/red]" in session.text() and "rate: 43" not in session.text()
        assert session.app.focused is focused
        await session.press("2")
        assert "average rate: 49" in session.text(), "it stays whatever pane is seen"
        await session.press("ctrl+o")
        assert streams[0].stopped and "average rate" not in session.text()

    run(live(), play, size)


def test_another_line_takes_its_place_and_an_end_is_told(streams: list[Printing]) -> None:
    async def play(session: Session) -> None:
        await begin(session)
        panel = await begin(session)
        assert [each.stopped for each in streams] == [True, False]
        streams[1].ended = True
        panel.look()
        await session.settle()
        assert "has ended" in session.text()
        await session.press("ctrl+o")
        assert not panel.is_open

    run(live(), play, (120, 40))


def test_a_line_that_ends_by_itself_shows_its_output(streams: list[Printing]) -> None:
    async def play(session: Session) -> None:
        await session.press(":")
        await session.type("ros2 node list")
        await session.press("enter")
        assert not streams and "/robot_navigator" in session.text()

    run(live(), play, (120, 40))
