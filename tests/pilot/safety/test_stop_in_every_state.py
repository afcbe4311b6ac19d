"""The stop key works while the console starts, once it is lost, read-only or closed, until the robot confirms."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Iterator

import pytest
from base_rig import Base, served_base
from bot_console.tui.app import BotConsoleApp
from bot_console.tui.console.command_gate import CLOSED, READ_ONLY
from bot_console.tui.console.graph.warning_log import GraphWarnings
from bot_console.tui.console.model import GraphInfo, LogFilter
from bot_console.tui.console.ros_console import RosConsole
from rigs import TIMEOUT_S, until


@pytest.fixture
def base(monkeypatch: pytest.MonkeyPatch) -> Iterator[Base]:
    with served_base(monkeypatch) as made:
        yield made


def connect(console: RosConsole) -> None:
    console.start()
    assert console.wait_ready(TIMEOUT_S)


def lose(console: RosConsole, monkeypatch: pytest.MonkeyPatch) -> None:
    """Make the console's own node fail."""

    def broken(self: GraphWarnings, graph: GraphInfo) -> None:
        raise RuntimeError("no warnings any more")

    monkeypatch.setattr(GraphWarnings, "follow", broken)
    connect(console)
    until(lambda: console.snapshot().problem, "the end of the connection")


def press_stop(console: RosConsole, play: Callable[[BotConsoleApp], None], *keys: str) -> None:
    """Show a console, press the stop key and any other keys, then run `play` while it is shown."""

    async def main() -> None:
        app = BotConsoleApp(console, refresh_hz=0)
        async with app.run_test(size=(80, 24)) as pilot:
            await pilot.press("exclamation_mark", *keys)
            await asyncio.to_thread(play, app)

    asyncio.run(main())


def status(app: BotConsoleApp) -> str:
    """The status line as it is drawn now."""
    app.call_from_thread(app.pull)
    return str(app.controls.status.render())


@pytest.mark.parametrize("state", ["starting", "connected", "lost", "read-only", "closed"])
def test_stop_key_locks_the_robot_in_every_state(state: str, base: Base, monkeypatch: pytest.MonkeyPatch) -> None:
    console = RosConsole()
    if state == "read-only":
        console.refuse_changes()
    if state in ("connected", "read-only", "closed"):
        connect(console)
    if state == "lost":
        lose(console, monkeypatch)
    if state == "closed":
        console.close()

    def play(app: BotConsoleApp) -> None:
        if state == "starting":
            assert "STOP NOT SENT: still connecting" in status(app)
            assert not base.is_held()
            connect(console)
        until(base.is_held, "the lock")
        until(lambda: console.snapshot().drive.stop_confirmed, "the confirmation")
        assert "ALL STOP held" in status(app)

    try:
        press_stop(console, play)
        assert base.is_held()
    finally:
        console.close()


def test_second_press_does_not_withdraw_a_stop_that_waits_for_the_connection(base: Base) -> None:
    console = RosConsole()

    def play(app: BotConsoleApp) -> None:
        assert "STOP NOT SENT: still connecting" in status(app)
        connect(console)
        until(base.is_held, "the lock")

    try:
        press_stop(console, play, "exclamation_mark")
    finally:
        console.close()


@pytest.mark.parametrize(("state", "why"), [("read-only", READ_ONLY), ("closed", CLOSED)])
def test_second_press_releases_nothing_where_commands_are_refused(state: str, why: str, base: Base) -> None:
    console = RosConsole()
    if state == "read-only":
        console.refuse_changes()
    connect(console)
    if state == "closed":
        console.close()

    def play(app: BotConsoleApp) -> None:
        until(lambda: console.snapshot().drive.stop_confirmed, "the confirmation")
        app.call_from_thread(app.pull)
        app.call_from_thread(app.action_all_stop)
        texts = [console.logs.record(each) for each in console.logs.matching(LogFilter(), 0)]
        assert any(each and f"the robot stays locked: {why}" in each.text for each in texts)
        assert base.is_held()

    try:
        press_stop(console, play)
    finally:
        console.close()
