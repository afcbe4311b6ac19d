"""Recording in the console: starting and ending a bag, and saving the last minutes afterwards."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import Future
from pathlib import Path

import pytest
import rclpy
from bot_console.tui.console.answer import Answer
from bot_console.tui.console.bags import recorder, recordings
from bot_console.tui.console.bags.reader import Bag
from bot_console.tui.console.bags.recording_sinks import BagSink, RingSink
from bot_console.tui.console.bags.recordings import Recordings
from bot_console.tui.console.bags.snapshot_ring import Ring
from bot_console.tui.console.bags.writer import BagWriter
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.serialization import deserialize_message, serialize_message
from rigs import until
from rosgraph_msgs.msg import Clock
from rosidl_runtime_py.utilities import get_message
from std_msgs.msg import String

LATCHED = [{"durability": "transient_local", "reliability": "reliable", "depth": 1}]


def texts(folder: Path, topic: str = "/words") -> list[str]:
    return [deserialize_message(each.data, String).data for each in Bag(folder).messages([topic])]


def answer_of(future: Future[Answer]) -> Answer:
    return future.result(timeout=240)


@pytest.fixture
def node() -> Iterator[rclpy.node.Node]:
    rclpy.init()
    made = rclpy.create_node("bags")
    yield made
    made.destroy_node()
    rclpy.try_shutdown()


@pytest.fixture
def room() -> Iterator[Recordings]:
    made = Recordings()
    yield made
    made.close()


def test_a_bag_is_recorded_from_start_to_stop(tmp_path: Path, node: rclpy.node.Node, room: Recordings) -> None:
    latched = node.create_publisher(
        String, "/map_name", QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    )
    latched.publish(String(data="office"))
    publisher = node.create_publisher(String, "/words", 10)
    node.create_publisher(Clock, "/clock", 10)
    assert not answer_of(room.stop()).ok and not answer_of(room.keep("x")).ok and room.info.folder == ""
    assert answer_of(room.start(str(tmp_path / "bag"))).ok
    assert room.info.folder == str(tmp_path / "bag") and room.info is room.info
    assert "already" in answer_of(room.start("another")).text  # by then all topics are being received
    assert publisher.get_subscription_count() == 1
    for number in range(20):
        publisher.publish(String(data=str(number)))
    answer = answer_of(room.stop())
    assert answer.ok and "messages of" in answer.text and room.info.folder == ""
    again = answer_of(room.start(str(tmp_path / "bag")))
    assert not again.ok and "exists already" in again.text
    assert texts(tmp_path / "bag") == [str(number) for number in range(20)]
    room.close()
    assert texts(tmp_path / "bag", "/map_name") == ["office"]
    assert "/clock" not in Bag(tmp_path / "bag").metadata.topics
    assert answer_of(room.start(str(tmp_path / "late"))) == Answer(False, "the console has closed")


def test_bag_contains_messages_published_just_before_its_end(
    tmp_path: Path, node: rclpy.node.Node, room: Recordings, monkeypatch: pytest.MonkeyPatch
) -> None:
    publisher = node.create_publisher(String, "/words", 10)
    turn, ended = recorder.Recorder.turn, list[Future[Answer]]()

    def turn_before_the_end(self: recorder.Recorder) -> None:
        turn(self)
        if not ended and publisher.get_subscription_count():
            publisher.publish(String(data="last"))
            ended.append(room.stop())

    monkeypatch.setattr(recorder.Recorder, "turn", turn_before_the_end)
    assert answer_of(room.start(str(tmp_path / "bag"))).ok
    until(lambda: ended, "the end")
    assert answer_of(ended[0]).ok
    assert texts(tmp_path / "bag") == ["last"]


def test_a_topic_of_an_unknown_type_is_named_until_its_type_is_known(
    tmp_path: Path, node: rclpy.node.Node, room: Recordings, monkeypatch: pytest.MonkeyPatch
) -> None:
    publisher = node.create_publisher(String, "/words", 10)
    known: list[str] = []

    def find(type_name: str) -> object:
        if not known:
            raise ModuleNotFoundError(f"No module named '{type_name}'")
        return get_message(type_name)

    monkeypatch.setattr(recordings, "get_message", find)
    monkeypatch.setattr(recorder, "TOPIC_POLL_S", 0.0)
    assert answer_of(room.start(str(tmp_path / "one"))).ok
    until(lambda: "/words" in room.info.missing, "the topic that is missing")
    ended = answer_of(room.stop()).text
    assert "/words was not recorded: its type std_msgs/msg/String is not available here (No module named" in ended
    assert answer_of(room.start(str(tmp_path / "two"))).ok
    until(lambda: "/words" in room.info.missing, "the topic that is missing")
    known.append("now")
    until(publisher.get_subscription_count, "the subscription")
    until(lambda: room.info.missing == (), "nothing missing")
    publisher.publish(String(data="late"))
    assert "not recorded" not in answer_of(room.stop()).text
    assert texts(tmp_path / "two") == ["late"]


def test_the_last_minutes_are_saved_with_earlier_latched_messages(tmp_path: Path) -> None:
    sink = RingSink(Ring(10.0, 10_000_000))
    sink.topic("/map_name", String, LATCHED)
    sink.topic("/rosout", String, LATCHED)
    sink.topic("/words", String, [])
    show_text = lambda text: serialize_message(String(data=text))  # noqa: E731
    sink.write("/map_name", show_text("office"), 10**9, 0)
    sink.write("/rosout", show_text("a line"), 10**9, 0)
    for second in range(2, 60):
        sink.write("/words", show_text(str(second)), second * 10**9, 0)
    writer = BagWriter(tmp_path / "bag")
    sink.pour(writer)
    writer.close()
    assert texts(tmp_path / "bag") == [str(second) for second in range(49, 60)]
    assert texts(tmp_path / "bag", "/map_name") == ["office"] and texts(tmp_path / "bag", "/rosout") == []
    assert Bag(tmp_path / "bag").metadata.begin == 49 * 10**9


def test_a_full_disk_ends_the_bag(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    sink = BagSink()
    sink.topic("/words", String, [])
    sink.begin(BagWriter(tmp_path / "bag"), 10**9)

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(sink.writer, "write", full)
    sink.write("/words", b"x", 10**9, 0)
    assert sink.writer is None and "No space left" in sink.problem and "bag" in sink.problem


def test_an_error_ends_one_bag_and_the_next_can_be_recorded(
    tmp_path: Path, node: rclpy.node.Node, room: Recordings, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(*_: object, **named: object) -> None:
        raise KeyError("a fault")

    with monkeypatch.context() as patch:
        patch.setattr("bot_console.tui.console.bags.recordings.Recorder", broken)
        assert answer_of(room.start(str(tmp_path / "first"))).ok
        thread = room._thread
        if thread is not None:
            thread.join(240)
    assert "a fault" in room.info.problem and not room.info.folder
    assert "a fault" in answer_of(room.stop()).text
    assert answer_of(room.start(str(tmp_path / "second"))).ok and not room.info.problem
    assert answer_of(room.stop()).ok and Bag(tmp_path / "second").files


def test_recording_in_simulated_time_ends_in_order_after_a_shutdown(tmp_path: Path, node: rclpy.node.Node) -> None:
    clock, words = node.create_publisher(Clock, "/clock", 10), node.create_publisher(String, "/words", 10)
    bag = BagWriter(tmp_path / "bag")
    made = recorder.Recorder(node, bag, lambda name, types: name == "/words", get_message, sim_time=True)
    clock.publish(Clock())
    words.publish(String(data="a"))
    rclpy.shutdown()  # as on SIGTERM
    made.close()
    bag.close()
    assert texts(tmp_path / "bag") == ["a"]


def test_a_console_that_keeps_no_last_minutes_says_which_one_does_and_what_can_be_done_here() -> None:
    answer = Recordings().keep("bag").result(0)
    assert not answer.ok and "the console that started the system" in answer.text and "R records" in answer.text
