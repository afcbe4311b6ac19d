"""The snapshot buffer: each message is kept once, in the order of sending, and saved as a bag."""

from __future__ import annotations

import time
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from bot_console.tui.console.bags.reader import Bag
from bot_console.tui.console.bags.snapshot_buffer import SnapshotBuffer
from bot_console.tui.console.bags.snapshot_size import SnapshotSize
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.serialization import deserialize_message, serialize_message
from rosgraph_msgs.msg import Clock
from std_msgs.msg import String

ONE, OTHER = b"1" * 16, b"2" * 16
SIZE = SnapshotSize(60.0, 10_000_000)


def endpoint(topic: str, kind: Any = String, *, latching: bool = False) -> Any:
    durability = DurabilityPolicy.TRANSIENT_LOCAL if latching else DurabilityPolicy.VOLATILE
    return SimpleNamespace(topic=topic, message_class=kind, qos=QoSProfile(depth=1, durability=durability))


def test_each_message_is_kept_once_in_the_order_of_sending_and_saved(tmp_path: Path) -> None:
    buffer = SnapshotBuffer(SIZE, serialize_message, lambda kind: f"RIHS01_{kind.__name__}")
    words, echo, now = endpoint("/words"), endpoint("/echo"), time.time_ns()
    buffer.hear(endpoint("/map_name", latching=True), OTHER, 1, now - 9000, String(data="office"))
    buffer.hear(endpoint("/clock", Clock), b"3" * 16, 1, now - 8000, Clock())
    buffer.hear(words, ONE, 2, now - 2000, serialize_message(String(data="second")))
    # received through another subscription
    buffer.hear(words, ONE, 2, now - 2000, serialize_message(String(data="second")))
    buffer.hear(echo, OTHER, 2, now - 3000, String(data="first"))
    answer = buffer.keep(str(tmp_path / "bag")).result(240)
    buffer.close()
    assert answer.ok and answer.text.startswith("the last 0 s, 3 messages, in ")
    bag = Bag(tmp_path / "bag")
    found = [(each.topic, deserialize_message(each.data, String).data) for each in bag.messages()]
    assert found == [("/map_name", "office"), ("/echo", "first"), ("/words", "second")]
    assert bag.metadata.topics["/words"].type_hash == "RIHS01_String"


def test_an_existing_folder_is_refused_and_keeping_continues(tmp_path: Path) -> None:
    buffer = SnapshotBuffer(SIZE, serialize_message, str)
    buffer.hear(endpoint("/words"), ONE, 1, time.time_ns(), String(data="word"))
    refused = buffer.keep(str(tmp_path)).result(240)
    assert not refused.ok and "exists already" in refused.text
    assert buffer.keep(str(tmp_path / "bag")).result(240).ok
    buffer.close()
