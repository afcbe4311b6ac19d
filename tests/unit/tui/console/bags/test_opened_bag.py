"""A bag as a console: it shows everything recorded, and refuses every change."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from bot_console.tui.console.bags import contents
from bot_console.tui.console.bags.contents import Contents
from bot_console.tui.console.bags.opened_bag import WHY, OpenedBag
from bot_console.tui.console.bags.reader import Bag
from bot_console.tui.console.bags.writer import BagWriter
from bot_console.tui.console.robot.robot_model import Pose
from bot_console.tui.widgets.status_bar import status_text
from builtin_interfaces.msg import Time
from nav_msgs.msg import MapMetaData, OccupancyGrid, Odometry
from rcl_interfaces.msg import Log, Parameter, ParameterEvent, ParameterValue
from rclpy.serialization import serialize_message

BEGIN = 1_700_000_000
SECOND = 10**9


def event(value: float, *, new: bool = False, node: str = "/nav") -> ParameterEvent:
    parameters = [Parameter(name="max_speed", value=ParameterValue(type=3, double_value=value))]
    return ParameterEvent(
        node=node, new_parameters=parameters if new else [], changed_parameters=[] if new else parameters
    )


def odometry(second: int) -> Odometry:
    message = Odometry()
    message.header.stamp = Time(sec=BEGIN + second - 1, nanosec=500_000_000)
    message.pose.pose.position.x = float(second)
    message.twist.twist.linear.x = second / 10
    return message


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    writer = BagWriter(tmp_path / "bag")

    def add(second: float, topic: str, message: Any) -> None:
        writer.topic(topic, type(message), [])
        writer.write(topic, serialize_message(message), int((BEGIN + second) * SECOND), 0)

    add(0, "/map", OccupancyGrid(info=MapMetaData(width=2, height=1, resolution=0.5), data=[0, 100]))
    add(0, "/parameter_events", event(1.0, new=True))
    for second in range(1, 11):
        add(second, "/odom", odometry(second))
    add(4, "/parameter_events", event(2.5))
    add(4, "/parameter_events", event(3.5, node="/_recorder"))
    add(5, "/rosout", Log(stamp=Time(sec=BEGIN + 5), level=30, name="nav", msg="too fast"))
    writer.close()
    return tmp_path / "bag"


@pytest.fixture
def console(folder: Path) -> OpenedBag:
    return OpenedBag(Contents(Bag(folder)), "bag")


def test_messages_are_those_of_the_time_being_viewed(console: OpenedBag) -> None:
    traffic = console.topics
    rate, size = traffic.measured()["/odom"].rate, len(serialize_message(odometry(1)))
    assert rate == 1.0 and traffic.measured()["/odom"].bandwidth == pytest.approx(size)
    assert traffic.heard().fields == ()
    traffic.listen("/odom")

    def position() -> str:
        return next(each.text for each in traffic.heard().fields if each.path == "pose.pose.position.x")

    assert position() == "10" and traffic.heard().count == 10 and traffic.heard() is traffic.heard()
    traffic.time_moved((BEGIN + 4) * SECOND)
    assert position() == "4" and traffic.heard().count == 4
    traffic.time_moved(BEGIN * SECOND)
    assert traffic.heard().fields == () and "no message has been recorded" in traffic.heard().problem
    traffic.time_moved(None)
    traffic.listen("/rosout")
    assert traffic.heard().topic == "/rosout" and traffic.heard().count == 1
    assert traffic.publish("/odom", "nav_msgs/msg/Odometry", {}).text == WHY


def test_log_parameter_changes_and_world_come_from_the_bag(console: OpenedBag) -> None:
    now = console.snapshot()
    assert [each.name for each in now.graph.topics] == ["/map", "/odom", "/parameter_events", "/rosout"]
    line = console.logs.record(0)
    assert line is not None and (line.text, line.stamp) == ("too fast", (BEGIN + 5) * SECOND)
    assert [*now.parameters] == ["/nav"], "hidden nodes are left out"
    (change,) = console.parameters.changes()
    assert (change.node, change.name, change.old, change.new) == ("/nav", "max_speed", 1.0, 2.5)
    assert change.stamp == (BEGIN + 4) * SECOND and now.journal.end == 1 and not now.journal.undoes
    assert now.world.map is not None and now.world.map.width == 2 and len(now.world.trail) == 10
    assert console.drive.pose_at((BEGIN + 3) * SECOND + 1) == Pose(3.0, 0.0, 0.0)
    assert now.link.to == "bag bag, 10 s" and console.snapshot() is now


def test_values_are_plotted_over_the_time_of_the_bag(console: OpenedBag) -> None:
    path = "/odom/twist.twist.linear.x"
    assert path in console.plots.plottable() and "/nav:max_speed" in console.plots.plottable()
    assert console.plots.watch(path).ok and console.plots.watch("/nav:max_speed").ok
    samples = console.plots.samples(path)
    assert list(samples.times) == [float(second) for second in range(1, 11)]
    assert list(samples.values) == pytest.approx([second / 10 for second in range(1, 11)])
    assert list(samples.headers) == [second - 0.5 for second in range(1, 11)]
    assert len(console.plots.samples(path, samples.cursor).times) == 0, "nothing more comes"
    changed = console.plots.samples("/nav:max_speed")
    assert list(zip(changed.times, changed.values, strict=True)) == [(0.0, 1.0), (4.0, 2.5)]
    assert console.plots.watch("/odom/pose.covariance[0:2].max()").ok, "the colon of a slice does not name a parameter"
    assert console.plots.time() == 10.0 and console.plots.time((BEGIN + 2) * SECOND) == 2.0
    for wrong in ("/odom/no.such", "/nothing/data", "/nav:none", "/odom"):
        assert not console.plots.watch(wrong).ok and console.plots.watch(wrong).text


def test_every_change_is_refused(console: OpenedBag) -> None:
    assert "robot" not in status_text(console.snapshot()), "no topic is awaited"
    (outcome,) = console.parameters.set("/nav", {"max_speed": 1.0}).result()
    assert not outcome.accepted and outcome.reason == WHY
    assert console.parameters.undo().result().text == WHY and console.bags.start("x").result().text == WHY


def test_the_largest_topic_of_a_bag_that_is_too_large_is_left_out(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(contents, "MAX_BYTES", 2000)
    held = Contents(Bag(folder))
    assert held.left_out == ["/odom"] and len(held.changes) == 1
