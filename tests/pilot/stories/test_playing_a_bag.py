"""A bag that is open is played by key into the ROS domain, with one cursor for the player and all panes."""

from __future__ import annotations

import asyncio
import queue
from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import Any

import pytest
from bot_console.tui.bag_app import BagApp, PlayerBar
from bot_console.tui.console.bags.contents import Contents
from bot_console.tui.console.bags.opened_bag import OpenedBag
from bot_console.tui.console.bags.playing import discovery
from bot_console.tui.console.bags.playing.bag_playback import BagPlayback
from bot_console.tui.console.bags.reader import Bag
from bot_console.tui.console.bags.writer import BagWriter
from bot_console.tui.panes.pane import Pane
from geometry_msgs.msg import Twist
from rclpy.serialization import deserialize_message, serialize_message
from rest import at_rest
from std_msgs.msg import Int32

pytest.importorskip("mcap")
SECOND = 10**9
BEGIN = 1_700_000_000 * SECOND
COUNT = 11
WAIT_S = 240


class PublishingNode:
    """Replaces the publishing node: keeps what is published, in order."""

    def __init__(self) -> None:
        self.numbers: queue.Queue[int] = queue.Queue()
        self.topics: list[str] = []

    def create_publisher(self, kind: Any, topic: str, qos: Any) -> Any:
        self.topics.append(topic)
        numbers = self.numbers

        class Publisher:
            topic_name = topic

            def get_subscription_count(self) -> int:
                return 0

            def publish(self, data: bytes) -> None:
                numbers.put(deserialize_message(data, Int32).data)

        return Publisher()

    def count_subscribers(self, topic: str) -> int:
        return 0

    def next(self) -> int:
        return self.numbers.get(timeout=WAIT_S)


@pytest.fixture(autouse=True)
def nobody_to_wait_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(discovery, "MIN_S", 0.0)


@pytest.fixture
def bag(tmp_path: Path) -> Bag:
    """A bag with a number each second, and a command."""
    writer = BagWriter(tmp_path / "bag")
    writer.topic("/number", Int32, [])
    writer.topic("/cmd_vel", Twist, [])
    writer.write("/cmd_vel", serialize_message(Twist()), BEGIN, 0)
    for number in range(COUNT):
        writer.write("/number", serialize_message(Int32(data=number)), BEGIN + number * SECOND, 0)
    writer.close()
    return Bag(tmp_path / "bag")


def run(bag: Bag, play: Callable[[BagApp, Any, PublishingNode], Awaitable[None]], **how: Any) -> None:
    published = PublishingNode()

    async def main() -> None:
        console = OpenedBag(Contents(bag), "bag")
        playback = BagPlayback(bag, how.pop("join", lambda: published))
        app = BagApp(console, refresh_hz=0, playback=playback, **how)
        app.time_cursor.follow(console.topics)
        try:
            with at_rest():
                async with app.run_test(size=(120, 30)) as pilot:
                    await pilot.pause()
                    await play(app, pilot, published)
        finally:
            playback.close()
            console.close()

    asyncio.run(main())


def player_message(app: BagApp) -> str:
    app.follow_player()
    return str(app.query_one(PlayerBar)._last_message)


def test_steps_and_seeking_move_the_cursor_of_all_panes(bag: Bag) -> None:
    async def play(app: BagApp, pilot: Any, published: PublishingNode) -> None:
        assert app.time_cursor.stamp is None and not published.topics, "nothing is played without a request"
        await pilot.press("number_sign")
        assert published.next() == 0
        assert "⏸ paused   0.0 / 10.0 s  ×1  1 message " in player_message(app) and app.time_cursor.stamp == BEGIN
        await pilot.press("right_parenthesis")
        assert app.time_cursor.stamp == BEGIN + 5 * SECOND
        await pilot.press("number_sign")
        assert published.next() == 5
        await pilot.press("left_parenthesis", "number_sign")
        assert published.next() == 0
        app.time_cursor.move(BEGIN + 7 * SECOND)
        await pilot.press("number_sign")
        assert published.next() == 7 and published.topics == ["/number"]
        app.console_of_robot.topics.listen("/number")
        player_message(app)
        assert app.console_of_robot.topics.heard().count == 8

    run(bag, play)


def test_playing_follows_rate_and_loop_and_pauses_at_the_end(bag: Bag) -> None:
    async def play(app: BagApp, pilot: Any, published: PublishingNode) -> None:
        await pilot.press("right_curly_bracket", "right_curly_bracket", "left_curly_bracket", "at")
        assert "×1.1  loop" in player_message(app)
        await pilot.press("at")
        app._playback.change_rate(1e8)
        await pilot.press("semicolon")
        assert [published.next() for _ in range(COUNT)] == list(range(COUNT))
        while not app._playback.state.paused:  # it waits at the end instead of leaving
            await pilot.pause()
        await pilot.press("semicolon")
        assert published.next() == 0, "and plays from the start again"

    run(bag, play)


def test_topics_that_command_a_robot_are_left_out_with_a_warning(bag: Bag) -> None:
    async def play(app: BagApp, pilot: Any, published: PublishingNode) -> None:
        notes: list[str] = []
        app.notify = lambda message, **_: notes.append(message)
        await pilot.press("number_sign", "number_sign")
        assert len(notes) == 1 and "/cmd_vel" in notes[0] and published.topics == ["/number"]

    run(bag, play)


def test_a_domain_that_cannot_be_joined_is_reported(bag: Bag) -> None:
    async def play(app: BagApp, pilot: Any, published: PublishingNode) -> None:
        await pilot.press("semicolon", "number_sign")
        assert player_message(app).startswith("no such domain") and not published.topics

    run(bag, play, join=lambda: "no such domain")


def test_bag_plays_at_once_on_request(bag: Bag) -> None:
    async def play(app: BagApp, pilot: Any, published: PublishingNode) -> None:
        assert published.next() == 0
        assert "▶ playing" in player_message(app)

    run(bag, play, plays=True)


@pytest.mark.slow
def test_player_continues_while_the_panes_are_dismantled(bag: Bag) -> None:
    async def play(app: BagApp, pilot: Any, published: PublishingNode) -> None:
        for pane in app.query(Pane):
            await pane.remove_children()
        app.time_cursor.move(BEGIN + SECOND)

    run(bag, play)
