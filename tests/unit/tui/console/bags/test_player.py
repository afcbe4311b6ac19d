"""A player that is paused, stepped, moved and changed in speed, and what it publishes."""

from __future__ import annotations

import queue
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from bot_console.tui.cli.bags.play import press, progress_line
from bot_console.tui.console.bags.definitions import class_of
from bot_console.tui.console.bags.merged_bags import MergedBags
from bot_console.tui.console.bags.playing.player import MAX_RATE, PlaybackOptions, Player
from bot_console.tui.console.bags.qos import read_overrides
from bot_console.tui.console.bags.reader import Bag
from bot_console.tui.console.bags.writer import BagWriter
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy
from rclpy.serialization import deserialize_message, serialize_message
from std_msgs.msg import Int32

pytest.importorskip("mcap")
SECOND = 10**9
COUNT = 10
BEGIN = 1_700_000_000 * SECOND
FAST = 1e9
WAIT_S = 240


class PublishingNode:
    """Replaces the publishing node: keeps what is published, in order."""

    def __init__(self) -> None:
        self.messages: queue.Queue[tuple[str, int]] = queue.Queue()
        self.profiles: dict[str, QoSProfile] = {}

    def create_publisher(self, kind: Any, topic: str, qos: Any) -> Any:
        self.profiles[topic] = qos
        outer = self

        class Publisher:
            def publish(self, data: Any) -> None:
                number = deserialize_message(data, Int32).data if isinstance(data, bytes) else data.clock.sec
                outer.messages.put((topic, number))

        return Publisher()

    def next(self) -> int:
        """The number that is published next."""
        return self.messages.get(timeout=WAIT_S)[1]


@pytest.fixture
def bag(tmp_path: Path) -> Bag:
    writer = BagWriter(tmp_path / "bag")
    writer.topic("/number", Int32, [])
    for number in range(COUNT):
        writer.write("/number", serialize_message(Int32(data=number)), BEGIN + number * SECOND, 0)
    writer.close()
    return Bag(tmp_path / "bag")


@contextmanager
def playing(bag: Any, **how: Any) -> Iterator[tuple[Player, PublishingNode, Callable[[], None]]]:
    """A running player; the third value waits for its end."""
    published, stopped = PublishingNode(), threading.Event()
    player = Player(published, bag, PlaybackOptions(**how), class_of)  # type: ignore[arg-type] -- it only publishes
    thread = threading.Thread(target=player.run, args=[stopped], daemon=True)
    thread.start()

    def ended() -> None:
        thread.join(WAIT_S)
        assert not thread.is_alive()

    try:
        yield player, published, ended
    finally:
        stopped.set()
        ended()


def test_single_steps_publish_one_message_each_and_move_the_position(bag: Bag) -> None:
    with playing(bag, paused=True) as (player, published, _):
        player.step()
        assert published.next() == 0
        player.step(2)
        assert (published.next(), published.next()) == (1, 2)
        assert player.position == BEGIN + 2 * SECOND and player.paused and published.messages.empty()


def test_a_running_player_is_paused_by_a_step(bag: Bag) -> None:
    with playing(bag, rate=0.01) as (player, published, _):
        assert published.next() == 0
        player.step()
        assert published.next() == 1 and player.paused


def test_seeking_continues_elsewhere_in_both_directions(bag: Bag) -> None:
    with playing(bag, paused=True) as (player, published, _):
        player.seek(BEGIN + 7 * SECOND)
        player.step()
        assert published.next() == 7
        player.seek(BEGIN + 2 * SECOND + 1)
        assert player.position == BEGIN + 2 * SECOND + 1
        player.step()
        assert published.next() == 3
        player.seek(0)
        assert player.position == BEGIN
        player.seek(2**62)
        assert player.position == BEGIN + (COUNT - 1) * SECOND


def test_a_player_that_was_moved_before_it_runs_begins_there_at_once(bag: Bag) -> None:
    published, stopped = PublishingNode(), threading.Event()
    player = Player(published, bag, PlaybackOptions(paused=True, rate=0.01), class_of)  # type: ignore[arg-type] -- it only publishes
    player.seek(BEGIN + 7 * SECOND)
    player.paused = False
    assert player.position == BEGIN + 7 * SECOND, "no time passes before it runs"
    thread = threading.Thread(target=player.run, args=[stopped], daemon=True)
    thread.start()
    try:
        assert published.next() == 7
    finally:
        stopped.set()
        thread.join(WAIT_S)


def test_a_paused_player_at_the_end_can_go_back(bag: Bag) -> None:
    with playing(bag, paused=True) as (player, published, ended):
        player.step(COUNT)
        assert [published.next() for _ in range(COUNT)] == list(range(COUNT))
        player.seek(BEGIN + 8 * SECOND)
        player.step()
        assert published.next() == 8
        player.rate = FAST
        player.paused = False
        ended()
        assert published.next() == 9 and player.published == COUNT + 2


def test_the_rate_changes_while_playing_and_stays_within_bounds(bag: Bag) -> None:
    with playing(bag, rate=0.01) as (player, published, ended):
        assert published.next() == 0
        player.rate = 1e30
        assert player.rate == MAX_RATE
        ended()
        assert [published.next() for _ in range(COUNT - 1)] == list(range(1, COUNT))
        assert player.position == player.end


def test_a_loop_begins_again_until_it_is_switched_off(bag: Bag) -> None:
    with playing(bag, rate=FAST, loop=True, offset=7.0) as (player, published, ended):
        assert [published.next() for _ in range(5)] == [7, 8, 9, 7, 8]
        player.loop = False
        ended()


def test_a_part_is_played(bag: Bag) -> None:
    with playing(bag, rate=FAST, offset=2.0, end=BEGIN + 4 * SECOND) as (_, published, ended):
        ended()
        assert [published.next() for _ in range(3)] == [2, 3, 4] and published.messages.empty()


def test_the_time_is_published_before_messages(bag: Bag) -> None:
    with playing(bag, rate=FAST, end=BEGIN + SECOND, clock_topics=None) as (_, published, ended):
        ended()
    found = [published.messages.get_nowait() for _ in range(4)]
    assert found == [("/clock", BEGIN // SECOND), ("/number", 0), ("/clock", BEGIN // SECOND + 1), ("/number", 1)]
    with playing(bag, rate=FAST, clock_topics=["/other"]) as (_, published, ended):
        ended()
    assert [published.messages.get_nowait()[0] for _ in range(COUNT)] == ["/number"] * COUNT


def test_several_bags_are_merged_by_time(bag: Bag, tmp_path: Path) -> None:
    writer = BagWriter(tmp_path / "other")
    writer.topic("/other", Int32, [])
    writer.write("/other", serialize_message(Int32(data=77)), BEGIN + 3 * SECOND + 1, 0)
    writer.close()
    with playing(MergedBags([bag, Bag(tmp_path / "other")]), rate=FAST) as (_, published, ended):
        ended()
    assert [published.next() for _ in range(COUNT + 1)] == [0, 1, 2, 3, 77, 4, 5, 6, 7, 8, 9]


def test_keys_control_the_player(bag: Bag) -> None:
    with playing(bag, paused=True) as (player, published, _):
        stopped = threading.Event()
        for key in ("right", "right"):
            press(player, key, stopped)
        assert (published.next(), published.next()) == (0, 1)
        for key in ("pagedown", "right"):
            press(player, key, stopped)
        assert published.next() == 6
        for key in ("left", "right"):
            press(player, key, stopped)
        assert published.next() == 1
        for key in ("up", "l", "home"):
            press(player, key, stopped)
        assert player.rate == pytest.approx(1.1) and player.loop
        assert progress_line(player) == "⏸ paused   0.0 / 9.0 s  ×1.1  loop  4 messages"
        press(player, "q", stopped)
        assert stopped.is_set()
        press(player, "space", stopped)
        assert not player.paused


def test_recorded_profiles_can_be_overridden(bag: Bag) -> None:
    profiles = read_overrides(
        "/number: {reliability: best_effort, durability: transient_local, history: keep_last, depth: 3,"
        " lifespan: {sec: 1, nsec: 5}, avoid_ros_namespace_conventions: false}\nother: {history: keep_all}"
    )
    with playing(bag, rate=FAST, qos=profiles) as (_, published, ended):
        ended()
    found = published.profiles["/number"]
    assert (found.reliability, found.depth) == (ReliabilityPolicy.BEST_EFFORT, 3)
    assert found.durability == DurabilityPolicy.TRANSIENT_LOCAL and found.lifespan.nanoseconds == SECOND + 5
    assert profiles["/other"].history == HistoryPolicy.KEEP_ALL


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("a: [", "not YAML"), ("[]", "map topics"), ("/a: 5", "map policies"), ("/a: {relability: x}", "no policy"),
        ("/a: {reliability: strong}", "cannot be 'strong'"), ("/a: {lifespan: 5}", "cannot be '5'"),
        ("/a: {deadline: {sec: x, nsec: 0}}", "deadline cannot"), ("/a: {depth: .inf}", "depth cannot"),
    ],
)  # fmt: skip
def test_wrong_profiles_are_explained(text: str, why: str) -> None:
    with pytest.raises(ValueError, match=why):
        read_overrides(text)
