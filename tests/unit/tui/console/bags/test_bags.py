"""Bags: other libraries can read them, files cut short are repaired, and playing keeps the order of messages."""

from __future__ import annotations

import errno
import os
import shutil
import sqlite3
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest
import rclpy
from action_tutorials_interfaces.action import Fibonacci
from bot_console.tui.console.bags import damage
from bot_console.tui.console.bags.contents import Contents
from bot_console.tui.console.bags.damage import BagError
from bot_console.tui.console.bags.definitions import definition, interface_type_name
from bot_console.tui.console.bags.opened_bag import OpenedBag
from bot_console.tui.console.bags.playing.player import PlaybackOptions, Player
from bot_console.tui.console.bags.qos import compatible_profile, offered_entries
from bot_console.tui.console.bags.reader import Bag
from bot_console.tui.console.bags.recorder import Recorder, in_order
from bot_console.tui.console.bags.snapshot_ring import MESSAGE_OVERHEAD_BYTES, Ring
from bot_console.tui.console.bags.writer import BagWriter
from bot_console.tui.files.save_file import NotSaved
from geometry_msgs.msg import Twist
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.serialization import deserialize_message, serialize_message
from rosidl_runtime_py.utilities import get_message
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Float64MultiArray, String

SECOND = 10**9


@pytest.fixture
def node() -> Iterator[rclpy.node.Node]:
    rclpy.init()
    made = rclpy.create_node("bags")
    yield made
    made.destroy_node()
    rclpy.try_shutdown()


def word_bag(folder: Path, *texts: str) -> Path:
    """A bag with one text message per second."""
    writer = BagWriter(folder)
    writer.topic("/words", String, [])
    for second, text in enumerate(texts, 1):
        writer.write("/words", serialize_message(String(data=text)), second * SECOND, 0)
    writer.close()
    return folder


def texts(bag: Bag) -> list[str]:
    return [deserialize_message(each.data, String).data for each in bag.messages()]


def test_rosbags_library_reads_a_written_bag(tmp_path: Path) -> None:
    highlevel = pytest.importorskip("rosbags.highlevel")
    mcap = pytest.importorskip("mcap.reader")
    writer = BagWriter(tmp_path / "bag")
    scan = LaserScan(ranges=[1.0, 2.5], angle_min=-0.5)
    scan.header.frame_id = "laser"
    qos = offered_entries([QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)])
    for name, kind, message in (
        ("/scan", LaserScan, scan),
        ("/twist", Twist, Twist()),
        ("/array", Float64MultiArray, Float64MultiArray(data=[1.0, 2.0])),
    ):
        writer.topic(name, kind, qos)
        writer.write(name, serialize_message(message), SECOND, SECOND - 1)
    writer.close()
    with highlevel.AnyReader([tmp_path / "bag"]) as reader:
        read = {each.topic: reader.deserialize(raw, each.msgtype) for each, _, raw in reader.messages()}
        assert reader.message_count == 3 and reader.duration == 1
        assert reader.connections[0].ext.offered_qos_profiles[0].depth == 5
    assert list(read["/scan"].ranges) == [1.0, 2.5] and read["/scan"].header.frame_id == "laser"
    assert list(read["/array"].data) == [1.0, 2.0]
    with (tmp_path / "bag" / "bag_0.mcap").open("rb") as file:
        found = [(schema.name, message.log_time) for schema, _, message in mcap.make_reader(file).iter_messages()]
    assert ("sensor_msgs/msg/LaserScan", SECOND) in found and len(found) == 3


def test_a_definition_contains_all_types_it_uses() -> None:
    text = definition(Twist)
    assert text.startswith("geometry_msgs/Vector3 linear\n") and "MSG: geometry_msgs/Vector3\nfloat64 x\n" in text
    assert interface_type_name(Twist) == "geometry_msgs/msg/Twist"
    assert "std_msgs/MultiArrayDimension[] dim" in definition(Float64MultiArray)
    assert "float64[36] covariance" in definition(get_message("geometry_msgs/msg/PoseWithCovariance"))


def test_a_bag_is_read_back_as_written(tmp_path: Path) -> None:
    bag = Bag(word_bag(tmp_path / "bag", "a", "b", "c"))
    assert texts(bag) == ["a", "b", "c"] and not bag.repaired
    about = bag.metadata
    assert (about.begin, about.end, about.count) == (SECOND, 3 * SECOND, 3)
    assert about.topics["/words"].type == "std_msgs/msg/String"
    assert [each.received for each in bag.messages(begin=2 * SECOND)] == [2 * SECOND, 3 * SECOND]
    assert list(bag.messages(["/other"])) == []


@pytest.mark.parametrize("part", [0.3, 0.5, 0.7, 0.9, 0.999])
def test_a_truncated_file_is_repaired_and_keeps_its_complete_messages(tmp_path: Path, part: float) -> None:
    folder = tmp_path / "bag"
    writer = BagWriter(folder)
    writer.topic("/words", String, [])
    for second in range(1, 101):
        writer.write("/words", serialize_message(String(data=str(second))), second * SECOND, 0)
        writer.flush()
    writer.close()
    file = folder / "bag_0.mcap"
    whole = file.read_bytes()
    file.write_bytes(whole[: int(len(whole) * part)])
    bag = Bag(folder)
    found = [int(each) for each in texts(bag)]
    assert len(bag.repaired) == 1 and found == list(range(1, len(found) + 1)) and len(found) > 15
    assert not Bag(folder).repaired and Bag(folder).metadata.count == len(found)


def test_a_file_damaged_before_its_end_is_kept_unchanged(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(damage, "MAX_CUT_BYTES", 4_000_000)
    file = word_bag(tmp_path / "bag", "first", *(["x" * 4_000_000] * 3)) / "bag_0.mcap"
    whole = file.read_bytes()
    begin = whole.index(b"x" * 100)
    broken = whole[: begin + 4_000_010] + b"\xff" * 100 + whole[begin + 4_000_110 : -100]
    file.write_bytes(broken)
    bag = Bag(file.parent)
    kept = file.with_name("bag_0.mcap.damaged")
    assert f"kept as {kept.name}" in bag.repaired[0] and kept.read_bytes() == broken
    assert texts(bag)[0] == "first" and not Bag(file.parent).repaired


def test_a_repair_that_fails_on_a_full_disk_leaves_the_file_unchanged(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = word_bag(tmp_path / "bag", "mine") / "bag_0.mcap"
    cut = file.read_bytes()[:-20]
    file.write_bytes(cut)

    def full(handle: int) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    with monkeypatch.context() as patched:
        patched.setattr(os, "fsync", full)
        with pytest.raises(BagError, match="cannot be given one: No space left"):
            Bag(file.parent)
    assert file.read_bytes() == cut and len(list(file.parent.iterdir())) == 2
    assert texts(Bag(file.parent)) == ["mine"]


def test_sqlite_bags_are_read(tmp_path: Path) -> None:
    folder = tmp_path / "bag"
    folder.mkdir()
    base = sqlite3.connect(folder / "bag_0.db3")
    base.execute("create table topics (id integer primary key, name, type, serialization_format, offered_qos_profiles)")
    base.execute("create table messages (id integer primary key, topic_id, timestamp, data)")
    base.execute("insert into topics values (1, '/words', 'std_msgs/msg/String', 'cdr', '')")
    for second, text in ((2, "b"), (1, "a")):
        data = serialize_message(String(data=text))
        base.execute("insert into messages (topic_id, timestamp, data) values (1, ?, ?)", (second * SECOND, data))
    base.commit()
    base.close()
    assert texts(Bag(folder)) == ["a", "b"] and Bag(folder).metadata.count == 2


def test_files_that_are_not_bags_are_refused(tmp_path: Path) -> None:
    (tmp_path / "empty").mkdir()
    (tmp_path / "bad.mcap").write_bytes(b"nothing of the kind")
    (tmp_path / "bad.db3").write_bytes(b"nothing of the kind")
    for name, message_of in (
        ("none", "no such bag"),
        ("empty", "no .mcap"),
        ("bad.mcap", "not an MCAP"),
        ("bad.db3", "database"),
    ):
        with pytest.raises(BagError, match=message_of):
            Bag(tmp_path / name)


@pytest.mark.parametrize("step", [12, pytest.param(3, marks=pytest.mark.slow), pytest.param(1, marks=pytest.mark.soak)])
def test_a_damaged_byte_anywhere_is_reported_or_harmless(tmp_path: Path, step: int) -> None:
    file = word_bag(tmp_path / "bag", "a", "b") / "bag_0.mcap"
    whole, reported = file.read_bytes(), 0
    for place in range(0, len(whole), step):
        file.write_bytes(whole[:place] + b"\xff" + whole[place + 1 :])
        try:
            contents = Contents(Bag(file.parent))
        except BagError:
            reported += 1
        else:
            reported += bool(contents.damage)
    assert reported > 20 / step


@pytest.mark.parametrize("stamp", ["'soon'", "-1", "9300000000000000000.0"])
def test_a_message_with_an_impossible_time_is_reported(tmp_path: Path, stamp: str) -> None:
    base = sqlite3.connect(tmp_path / "bag_0.db3")
    base.execute("create table topics (id integer primary key, name, type, serialization_format, offered_qos_profiles)")
    base.execute("create table messages (id integer primary key, topic_id, timestamp, data)")
    base.execute("insert into topics values (1, '/words', 'std_msgs/msg/String', 'cdr', '!!int')")
    base.execute(f"insert into messages (topic_id, timestamp, data) values (1, {stamp}, x'00')")
    base.commit()
    base.close()
    with pytest.raises(BagError, match="is damaged: a message is dated"):
        Bag(tmp_path)


def test_invalid_metadata_yaml_does_not_prevent_reading(tmp_path: Path) -> None:
    folder = word_bag(tmp_path / "bag", "mine")
    for about in ("!!int", f"{{relative_file_paths: [{'long' * 100}.mcap]}}"):
        (folder / "metadata.yaml").write_text(f"rosbag2_bagfile_information: {about}")
        assert texts(Bag(folder)) == ["mine"]


@pytest.mark.parametrize("type_name", ["", "/msg/String", "std_msgs", "std_msgs/msg/", "../x/y", "a b/msg/C"])
def test_a_topic_of_an_impossible_type_is_reported(tmp_path: Path, type_name: str) -> None:
    with sqlite3.connect(tmp_path / "bag_0.db3") as base:
        base.execute("create table topics (id integer, name, type, serialization_format, offered_qos_profiles)")
        base.execute("create table messages (id integer primary key, topic_id, timestamp, data)")
        base.execute("insert into topics values (1, '/words', ?, 'cdr', '')", (type_name,))
        base.execute("insert into messages (topic_id, timestamp, data) values (1, 5, x'00')")
    console = OpenedBag(Contents(Bag(tmp_path)), "bag")
    console.topics.listen("/words")
    assert "cannot be read" in console.topics.heard().problem
    assert not console.plots.watch("/words/data").ok
    console.close()


def test_metadata_cannot_refer_to_files_outside_the_bag(tmp_path: Path) -> None:
    folder = word_bag(tmp_path / "bag", "mine")
    word_bag(tmp_path / "other", "theirs")
    about = folder / "metadata.yaml"
    about.write_text(about.read_text().replace("bag_0.mcap", "../other/other_0.mcap"))
    assert texts(Bag(folder)) == ["mine"]


def test_an_existing_bag_is_never_overwritten(tmp_path: Path) -> None:
    word_bag(tmp_path / "bag", "a")
    with pytest.raises(NotSaved, match="exists already"):
        BagWriter(tmp_path / "bag")


def test_recorded_messages_can_be_played(tmp_path: Path, node: rclpy.node.Node) -> None:
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    publisher = node.create_publisher(String, "/words", latched)
    other = node.create_publisher(String, "/hidden", 10)
    publisher.publish(String(data="before"))
    writer = BagWriter(tmp_path / "bag")
    recorder = Recorder(node, writer, lambda name, _: name == "/words", get_message)
    for text in ("one", "two"):
        publisher.publish(String(data=text))
        other.publish(String(data="no"))
        recorder.turn()
    recorder.close()
    writer.close()
    bag = Bag(tmp_path / "bag")
    assert texts(bag)[-2:] == ["one", "two"] and list(recorder.subscribed) == ["/words"]
    assert bag.metadata.topics["/words"].qos[0]["durability"] == "transient_local"
    heard: list[str] = []
    node.create_subscription(String, "/again", lambda message: heard.append(message.data), 10)
    player = Player(node, bag, PlaybackOptions(rate=1e6, remaps={"/words": "/again"}), get_message)
    player.run(threading.Event())
    for _ in range(10):
        rclpy.spin_once(node, timeout_sec=0.05)
    assert heard == texts(bag) and player.published == len(heard)


def test_messages_taken_at_once_are_ordered_by_sending_time_unless_clocks_differ() -> None:
    now, foreign = 100 * SECOND, 90 * SECOND
    found = [(now - 1, "/late", b"c"), (now - 3, "/early", b"a"), (foreign, "/foreign", b"d"), (now - 2, "/late", b"b")]
    ordered = [(received - now, data) for received, _, data, _ in in_order(found, now, last=0)]
    assert ordered == [(-3, b"a"), (-2, b"b"), (-1, b"c"), (0, b"d")]
    assert [each[0] for each in in_order(found, now, last=now - 2)] == [now - 2, now - 2, now - 1, now]


def test_a_topic_of_an_unknown_type_is_reported(tmp_path: Path, node: rclpy.node.Node) -> None:
    folder = word_bag(tmp_path / "bag", "a")
    bag = Bag(folder)
    bag.metadata.topics["/words"].type = "nobody_msgs/msg/Such"
    player = Player(node, bag, PlaybackOptions(), get_message)
    player.run(threading.Event())
    assert "nobody_msgs/msg/Such" in player.unknown["/words"] and player.published == 0


def test_a_topic_whose_name_is_not_valid_is_reported(tmp_path: Path, node: rclpy.node.Node) -> None:
    bag = Bag(word_bag(tmp_path / "bag", "a"))
    bag.metadata.topics["/wo~ds"] = bag.metadata.topics.pop("/words")
    player = Player(node, bag, PlaybackOptions(), get_message)
    player.run(threading.Event())
    assert "'/wo~ds' is not a valid topic name" in player.unknown["/wo~ds"] and player.published == 0


@pytest.mark.parametrize(("depth", "taken"), [(7, 7), ("²", 10), (10**40, 10), (-1, 10), (None, 10), ([], 10)])
def test_a_recorded_depth_that_no_middleware_holds_is_left_out(depth: object, taken: int) -> None:
    assert compatible_profile([{"depth": depth}]).depth == taken


def test_a_ring_keeps_the_last_seconds_within_its_byte_limit(tmp_path: Path) -> None:
    ring = Ring(seconds=10, maximum=100_000)
    ring.topic("/words", String, [], "")
    data = serialize_message(String(data="x"))
    for second in range(1, 31):
        ring.write("/words", data, second * SECOND, 0)
    writer = BagWriter(tmp_path / "bag")
    assert ring.pour(writer) == 11
    writer.close()
    assert Bag(tmp_path / "bag").metadata.begin == 20 * SECOND
    ring = Ring(seconds=10, maximum=2 * (400 + MESSAGE_OVERHEAD_BYTES) + 200)
    ring.topic("/words", String, [], "")
    for second in range(31, 60):
        ring.write("/words", b"\0" * 400, second * SECOND // 100 + 30 * SECOND, 0)
    shutil.rmtree(tmp_path / "bag")
    writer = BagWriter(tmp_path / "bag")
    assert ring.pour(writer) == 2
    writer.close()


def test_offered_qos_profiles_are_restored_from_a_bag() -> None:
    weak = QoSProfile(depth=7, reliability=ReliabilityPolicy.BEST_EFFORT)
    again = compatible_profile(offered_entries([weak]))
    assert again.reliability == ReliabilityPolicy.BEST_EFFORT and again.depth == 7
    both = compatible_profile(offered_entries([weak, QoSProfile(depth=2, durability=DurabilityPolicy.TRANSIENT_LOCAL)]))
    assert both.reliability == ReliabilityPolicy.RELIABLE and both.durability == DurabilityPolicy.TRANSIENT_LOCAL
    assert compatible_profile([{"depth": "many", "history": 3}]).depth == 10


def test_the_definition_of_action_feedback_includes_nested_types() -> None:
    text = definition(Fibonacci.Impl.FeedbackMessage)
    assert "MSG: action_tutorials_interfaces/Fibonacci_Feedback\nint32[] partial_sequence\n" in text
    assert "MSG: unique_identifier_msgs/UUID\nuint8[16] uuid\n" in text
