"""Topics whose type has no definition here are recorded as raw bytes, and played back byte by byte.

The other side is a captured node of rmw_zenoh_cpp behind a router, whose type is unknown here.
"""

from __future__ import annotations

import math
import threading
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any

import pytest
import rclpy
from bot_console.runtime.rmw.local import local_bus
from bot_console.runtime.rmw.middleware import choose_middleware
from bot_console.runtime.rmw.zenoh.network.client import ClientConfig
from bot_console.runtime.rmw.zenoh.network.router import Router
from bot_console.runtime.rmw.zenoh.settings import Serving
from bot_console.tui.cli.verbs.bag import run as bag_verb
from bot_console.tui.console.bags import recordings
from bot_console.tui.console.bags.definitions import class_of
from bot_console.tui.console.bags.playing.player import PlaybackOptions, Player
from bot_console.tui.console.bags.reader import Bag
from bot_console.tui.console.bags.recorder import Recorder
from bot_console.tui.console.bags.recordings import Recordings
from bot_console.tui.console.bags.writer import BagWriter, WritingOptions
from bot_console.tui.session.embedded.connecting import connect
from bot_console.tui.session.embedded.hooks import DomainTypes
from mcap.reader import make_reader
from processes.captured_node import CapturedNode
from processes.ports import free_port
from rclpy.context import Context
from rigs import until
from std_msgs.msg import String

SUCH, HASH = "nobody_msgs/msg/Such", "RIHS01_" + "5a" * 32
ON_WIRE = "nobody_msgs::msg::dds_::Such_"
DATA = [b"\x00\x01\x00\x00" + bytes([number, 0, 255]) for number in range(20)]
FIRST = b"\x00\x01\x00\x00first"
TOPIC, AGAIN = "/latched", "/tl_sub"


@pytest.fixture
def config() -> Iterator[ClientConfig]:
    serving = Serving((f"tcp/127.0.0.1:{free_port()}",))
    router = Router(serving)
    buses = connect(ClientConfig(serving.endpoints))
    yield ClientConfig(serving.endpoints)
    buses.close()
    choose_middleware(local_bus)
    router.close()


@pytest.fixture
def captured(config: ClientConfig) -> Iterator[Callable[..., CapturedNode]]:
    """Makes endpoints of the node behind the router."""
    made: list[CapturedNode] = []

    def make(kind: str, type_name: str = ON_WIRE, type_hash: str = HASH) -> CapturedNode:
        topic = TOPIC if kind == "MP" else AGAIN
        made.append(CapturedNode(config, kind, topic, type_name=type_name, type_hash=type_hash))
        return made[-1]

    yield make
    for each in made:
        each.session.close()


@pytest.fixture
def node(config: ClientConfig) -> Iterator[Any]:
    context = Context()
    rclpy.init(args=[], context=context, domain_id=0)
    made = rclpy.create_node("bags", context=context, enable_rosout=False, start_parameter_services=False)
    yield made
    made.destroy_node()
    context.shutdown()


class NotingWriter(BagWriter):
    """A writer that keeps the last message."""

    last = b""

    def write(self, topic: str, data: bytes, received: int, sent: int) -> None:
        super().write(topic, data, received, sent)
        self.last = data


def after_discovery(payloads: Iterable[bytes]) -> list[bytes]:
    """The payloads without the messages from before the subscription was known."""
    return [each for each in payloads if each != FIRST]


def record(folder: Path, node: Any, talker: CapturedNode, storage: str = "mcap") -> tuple[Bag, Recorder]:
    """Record what a node sends."""
    writer = NotingWriter(folder, WritingOptions(storage))
    made = Recorder(
        *(node, writer, lambda name, _: name == TOPIC, class_of),
        poll_s=0.0,
        generic=DomainTypes(),
    )

    def begun() -> bool:
        talker.send(FIRST)  # repeatedly, since the node does not know when the subscription has reached it
        made.turn()
        return writer.last != b""

    until(begun, "the subscription")
    for each in DATA:
        talker.send(each)

    def complete() -> bool:
        made.turn()
        return writer.last == DATA[-1]

    until(complete, "the messages")
    made.close()
    writer.close()
    return Bag(folder), made


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_messages_of_a_type_without_a_definition_are_recorded_and_played_as_they_are(
    tmp_path: Path, node: Any, captured: Callable[..., CapturedNode], storage: str
) -> None:
    bag, made = record(tmp_path / "bag", node, captured("MP"), storage)
    about = bag.topics[TOPIC]
    assert (about.type, about.type_hash, about.encoding) == (SUCH, HASH, "cdr")
    assert after_discovery(each.data for each in bag.messages()) == DATA
    assert made.unknown == {} and f"its type {SUCH} is not available here" in made.generic[TOPIC]

    listener = captured("MS")
    player = Player(node, bag, PlaybackOptions(rate=1e9, remaps={TOPIC: AGAIN}), class_of, DomainTypes())
    assert player.unknown == {}
    until(player._publishers[TOPIC].get_subscription_count, "the listener")
    player.run(threading.Event())
    until(lambda: DATA[-1] in listener.payloads, "the messages")
    assert after_discovery(listener.payloads) == DATA


def test_a_bag_has_no_definition_where_none_is_known(
    tmp_path: Path, node: Any, captured: Callable[..., CapturedNode], capsys: pytest.CaptureFixture[str]
) -> None:
    record(tmp_path / "bag", node, captured("MP"))
    with (tmp_path / "bag" / "bag_0.mcap").open("rb") as file:
        summary = make_reader(file).get_summary()
    assert summary is not None
    assert [(each.name, each.encoding, each.data) for each in summary.schemas.values()] == [(SUCH, "", b"")]
    assert bag_verb(["info", str(tmp_path / "bag")]) == 0
    assert f"Topic: {TOPIC} | Type: {SUCH} | Count: " in capsys.readouterr().out


def test_a_type_that_is_defined_otherwise_here_is_recorded_without_a_definition(
    tmp_path: Path, node: Any, captured: Callable[..., CapturedNode]
) -> None:
    bag, made = record(tmp_path / "bag", node, captured("MP", "std_msgs::msg::dds_::String_"))
    assert after_discovery(each.data for each in bag.messages()) == DATA and bag.topics[TOPIC].type_hash == HASH
    assert f"it is defined otherwise than by {HASH}" in made.generic[TOPIC]


def test_a_console_records_without_a_definition_once_it_has_waited_for_one(
    tmp_path: Path, node: Any, captured: Callable[..., CapturedNode]
) -> None:
    writer = BagWriter(tmp_path / "bag")
    captured("MP")
    until(lambda: node.count_publishers(TOPIC), "the publisher")
    made = Recorder(
        *(node, writer, lambda name, _: name == TOPIC, class_of),
        poll_s=0.0,
        generic=DomainTypes(),
        definition_timeout_s=math.inf,
    )
    assert TOPIC in made.unknown and not made.subscribed
    made._definition_timeout_s = 0.0
    made.turn()
    assert TOPIC in made.generic and TOPIC in made.subscribed and not made.unknown
    made.close()
    writer.close()


def test_a_recording_says_at_its_end_which_topics_have_no_definition(
    tmp_path: Path, config: ClientConfig, captured: Callable[..., CapturedNode], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(recordings, "DEFINITION_TIMEOUT_S", 0.0)
    room = Recordings(generic=DomainTypes())
    try:
        captured("MP")
        assert room.start(str(tmp_path / "bag")).result(240).ok
        until(lambda: room._recorder is not None and TOPIC in room._recorder.generic, "the topic")
        assert room.info.missing == ()
        assert f"{TOPIC} was recorded without a definition" in room.stop().result(240).text
    finally:
        room.close()


def test_message_without_a_definition_reaches_only_raw_subscriptions_of_the_same_program() -> None:
    rclpy.init()
    try:
        node = rclpy.create_node("both")
        heard: list[String] = []
        node.create_subscription(String, "/t", heard.append, 10)
        raw = node.create_subscription(String, "/t", heard.append, 10, raw=True)
        kind = DomainTypes().generic_class("std_msgs/msg/String", DomainTypes().type_hash(String))
        publisher = node.create_publisher(kind, "/t", 10)
        publisher.publish(DATA[0])
        assert publisher.get_subscription_count() == 1 and raw.handle.take_message(String, True)[0] == DATA[0]
        rclpy.spin_once(node, timeout_sec=0.0)
        assert heard == []
    finally:
        rclpy.try_shutdown()
