"""What runs beside a ROS test: a spinning node, a message pump, and output filters."""

from __future__ import annotations

import threading
from pathlib import Path

import pytest
import rclpy
from launch_testing_ros import DataRepublisher, MessagePump
from launch_testing_ros.tools import basic_output_filter
from launch_testing_ros.tools.output import get_rmw_output_filter
from std_msgs.msg import String


def test_messages_are_changed_while_a_node_spins() -> None:
    rclpy.init()
    node = rclpy.create_node("between")
    heard: list[str] = []
    twice = threading.Event()

    def hear(message: String) -> None:
        heard.append(message.data)
        if len(heard) == 2:
            twice.set()

    node.create_subscription(String, "loud", hear, 10)
    publisher = node.create_publisher(String, "quiet", 10)
    changed = DataRepublisher(
        node, "quiet", "loud", String, lambda message: String(data=message.data.upper()) if message.data else None
    )
    with MessagePump(node):
        for text in ("one", "", "two"):
            publisher.publish(String(data=text))
        assert twice.wait(240.0)
    assert heard == ["ONE", "TWO"]
    assert (changed.get_num_received(), changed.get_num_republished()) == (3, 2)
    assert [each.data for each in changed.get_republished()] == ["one", "two"]
    changed.shutdown()
    node.destroy_node()
    rclpy.shutdown()


def test_filter_removes_lines_of_the_middleware(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for kind, text in (("prefixes", "[W]\n"), ("patterns", r".*\d+ ms")):
        folder = tmp_path / "share/ament_index/resource_index" / f"rmw_output_{kind}"
        folder.mkdir(parents=True)
        (folder / "rmw_some").write_text(text)
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path))
    output = "pid 7\n[W] slow\nafter 5 ms\nhello\n"
    assert basic_output_filter(filtered_rmw_implementation="rmw_some")(output) == "hello\n"
    assert basic_output_filter([], filtered_rmw_implementation="rmw_other")(output) == output
    with pytest.raises(TypeError, match="Unsupported filter_type"):
        get_rmw_output_filter("rmw_some", "lines")
