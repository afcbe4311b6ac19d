"""Message delivery: order, depth, late joiners, lifespan, copies, infos, errors."""

from __future__ import annotations

from array import array
from typing import Any

import pytest
from geometry_msgs.msg import Twist
from rclpy._rclpy_pybind11 import InvalidHandle, RCLError
from rclpy.clock import Clock
from rclpy.duration import Duration
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy
from rclpy.serialization import deserialize_message, serialize_message
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Float32, Int32, String
from std_srvs.srv import Trigger

DESTROYED = "cannot use Destroyable because destruction was requested"
LATCHED = DurabilityPolicy.TRANSIENT_LOCAL


class IntegerTopic:
    """A topic of integers from a node to itself."""

    def __init__(self, ros: Any, publisher_qos: Any = 10, subscription_qos: Any = 10) -> None:
        self.ros = ros
        self.node = ros.node()
        self.got: list[int] = []
        self._subscription_qos = subscription_qos
        self.publisher = self.node.create_publisher(Int32, "t", publisher_qos)

    def subscribe(self) -> Any:
        """Create the subscription."""
        return self.node.create_subscription(
            Int32, "t", lambda message: self.got.append(message.data), self._subscription_qos
        )

    def send(self, count: int) -> None:
        """Publish 0, 1, 2 ..."""
        for number in range(count):
            self.publisher.publish(Int32(data=number))

    def arrived(self) -> list[int]:
        """Return the received messages after all callbacks have run."""
        self.ros.settle()
        return self.got


@pytest.mark.parametrize(
    ("publisher_qos", "subscription_qos", "numbers"),
    [
        (10, 10, [0, 1, 2, 3, 4]),
        (1, 10, [0, 1, 2, 3, 4]),
        (10, 2, [3, 4]),
        (10, 1, [4]),
        (10, QoSProfile(history=HistoryPolicy.KEEP_ALL), [0, 1, 2, 3, 4]),
        (10, QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT), [0, 1, 2, 3, 4]),
        (QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT), 10, []),
        (10, QoSProfile(depth=10, durability=LATCHED), []),
        (QoSProfile(depth=10, durability=LATCHED), 10, [0, 1, 2, 3, 4]),
    ],
)
def test_messages_arrive_according_to_qos(
    ros: Any, publisher_qos: Any, subscription_qos: Any, numbers: list[int]
) -> None:
    line = IntegerTopic(ros, publisher_qos, subscription_qos)
    line.subscribe()
    line.send(5)
    assert line.arrived() == numbers


@pytest.mark.parametrize(
    ("publisher_qos", "subscription_qos", "numbers"),
    [
        ({"depth": 10, "durability": LATCHED}, {"depth": 10, "durability": LATCHED}, [0, 1, 2, 3, 4]),
        ({"depth": 2, "durability": LATCHED}, {"depth": 10, "durability": LATCHED}, [3, 4]),
        ({"depth": 10, "durability": LATCHED}, {"depth": 3, "durability": LATCHED}, [2, 3, 4]),
        ({"depth": 10, "durability": LATCHED}, {"depth": 10}, []),
        ({"depth": 10}, {"depth": 10}, []),
    ],
)
def test_late_joiners_get_latched_messages(
    ros: Any, publisher_qos: Any, subscription_qos: Any, numbers: list[int]
) -> None:
    line = IntegerTopic(ros, QoSProfile(**publisher_qos), QoSProfile(**subscription_qos))
    line.send(5)
    line.subscribe()
    assert line.arrived() == numbers


def test_late_joiner_continues_with_new_messages(ros: Any) -> None:
    line = IntegerTopic(ros, QoSProfile(depth=1, durability=LATCHED), QoSProfile(depth=10, durability=LATCHED))
    line.send(3)
    line.subscribe()
    line.publisher.publish(Int32(data=9))
    assert line.arrived() == [2, 9]


def test_latched_messages_of_a_destroyed_publisher_are_gone(ros: Any) -> None:
    line = IntegerTopic(ros, QoSProfile(depth=5, durability=LATCHED), QoSProfile(depth=5, durability=LATCHED))
    line.send(3)
    line.node.destroy_publisher(line.publisher)
    line.subscribe()
    assert line.arrived() == []


@pytest.mark.parametrize(("waited", "numbers"), [(0.05, [0]), (0.2, [])])
def test_lifespan_expires_waiting_messages(stepped_ros: Any, waited: float, numbers: list[int]) -> None:
    line = IntegerTopic(stepped_ros, QoSProfile(depth=5, lifespan=Duration(seconds=0.1)))
    line.subscribe()
    line.send(1)
    Clock().sleep_for(Duration(seconds=waited), line.node.context)
    assert line.arrived() == numbers


@pytest.mark.parametrize(("waited", "numbers"), [(0.05, [0]), (0.2, [])])
def test_lifespan_expires_latched_messages(stepped_ros: Any, waited: float, numbers: list[int]) -> None:
    qos = QoSProfile(depth=5, durability=LATCHED, lifespan=Duration(seconds=0.1))
    line = IntegerTopic(stepped_ros, qos, QoSProfile(depth=5, durability=LATCHED))
    line.send(1)
    Clock().sleep_for(Duration(seconds=waited), line.node.context)
    line.subscribe()
    assert line.arrived() == numbers


def test_topics_with_different_types_do_not_mix(ros: Any) -> None:
    line = IntegerTopic(ros)
    line.subscribe()
    line.node.create_publisher(String, "t", 10).publish(String(data="x"))
    assert line.arrived() == []


def test_every_subscription_gets_its_own_copy(ros: Any) -> None:
    node, got = ros.node(), []
    for _ in range(2):
        node.create_subscription(LaserScan, "scan", got.append, 10)
    scan = LaserScan(ranges=[1.0, 2.0])
    node.create_publisher(LaserScan, "scan", 10).publish(scan)
    scan.ranges[0] = 99.0
    scan.header.frame_id = "changed"
    ros.settle()
    got[0].ranges[1] = 77.0
    assert [list(each.ranges) for each in got] == [[1.0, 77.0], [1.0, 2.0]]
    assert [each.header.frame_id for each in got] == ["", ""]
    assert isinstance(got[0].ranges, array)


def test_changes_by_a_callback_are_invisible_to_others(ros: Any) -> None:
    node, got = ros.node(), []
    profile = QoSProfile(depth=2, durability=LATCHED)

    def change(scan: LaserScan) -> None:
        got.append((list(scan.ranges), scan.header.frame_id))
        scan.ranges[0] = 99.0
        scan.header.frame_id = "changed"

    for _ in range(3):
        node.create_subscription(LaserScan, "scan", change, profile)
    taken = node.create_subscription(LaserScan, "scan", change, profile).take
    publisher = node.create_publisher(LaserScan, "scan", profile)
    for _ in range(3):  # one more than the queue holds
        publisher.publish(LaserScan(ranges=[1.0]))
    change(taken()[0])
    ros.settle()
    node.create_subscription(LaserScan, "scan", change, profile)
    ros.settle()
    assert got == [([1.0], "")] * (4 * 2 + 2)


def test_publishing_costs_one_copy_for_any_number_of_subscriptions(ros: Any, monkeypatch: Any) -> None:
    node, copies = ros.node(), []
    copy = LaserScan._copy_
    monkeypatch.setattr(LaserScan, "_copy_", lambda scan: copies.append(1) or copy(scan))
    for _ in range(20):
        node.create_subscription(LaserScan, "scan", lambda scan: None, 1)
    publisher = node.create_publisher(LaserScan, "scan", 10)
    publisher.publish(LaserScan())
    publisher.publish(LaserScan())
    assert len(copies) == 2
    ros.settle()
    assert len(copies) == 2 + 19


def test_values_are_rounded_as_on_the_wire(ros: Any) -> None:
    node, got = ros.node(), []
    node.create_subscription(Float32, "t", got.append, 10)
    node.create_publisher(Float32, "t", 10).publish(Float32(data=0.1))
    ros.settle()
    assert got[0].data == 0.10000000149011612


def test_raw_subscription_gets_serialized_messages(ros: Any) -> None:
    node, whole, raw = ros.node(), [], []
    node.create_subscription(Int32, "t", whole.append, 10)
    node.create_subscription(Int32, "t", raw.append, 10, raw=True)
    publisher = node.create_publisher(Int32, "t", 10)
    publisher.publish(serialize_message(Int32(data=3)))
    publisher.publish(Int32(data=4))
    ros.settle()
    assert [each.data for each in whole] == [3, 4]
    assert [deserialize_message(each, Int32).data for each in raw] == [3, 4]


def test_callback_may_take_message_info(stepped_ros: Any) -> None:
    node, got = stepped_ros.node(), []
    node.create_subscription(Int32, "t", lambda message, info: got.append((message.data, info)), 10)
    publisher = node.create_publisher(Int32, "t", 10)
    start = node.get_clock().now().nanoseconds
    for number in (7, 8):
        publisher.publish(Int32(data=number))
    stepped_ros.settle()
    assert [data for data, _ in got] == [7, 8]
    assert [info["publication_sequence_number"] for _, info in got] == [1, 2]
    assert [info["source_timestamp"] for _, info in got] == [start, start]
    assert all(info["received_timestamp"] >= start for _, info in got)


def test_message_that_waits_was_received_when_it_was_published(stepped_ros: Any) -> None:
    node = stepped_ros.node()
    subscription = node.create_subscription(Int32, "t", lambda message: None, 10)
    publisher = node.create_publisher(Int32, "t", 10)
    sent = node.get_clock().now().nanoseconds
    publisher.publish(Int32(data=7))
    Clock().sleep_for(Duration(seconds=0.5), node.context)
    _, info = subscription.take()
    assert info["received_timestamp"] == sent


@pytest.mark.parametrize("callback", [lambda: None, lambda a, b, c: None])
def test_callbacks_with_other_signatures_are_rejected(ros: Any, callback: Any) -> None:
    with pytest.raises(RuntimeError, match="callback should be either be callable with one argument"):
        ros.node().create_subscription(Int32, "t", callback, 10)


def test_callback_can_be_replaced(ros: Any) -> None:
    line = IntegerTopic(ros)
    subscription, got = line.subscribe(), []
    subscription.callback = lambda message, info: got.append(message.data)
    line.send(1)
    line.arrived()
    assert (line.got, got) == ([], [0])


@pytest.mark.parametrize("message", [Twist(), 5, None, "x", Int32])
def test_publisher_rejects_messages_of_another_type(ros: Any, message: Any) -> None:
    publisher = ros.node().create_publisher(Int32, "t", 10)
    with pytest.raises(TypeError, match=r"^Expected <class 'std_msgs.msg._int32.Int32'>, got <class "):
        publisher.publish(message)


def test_wrong_field_is_reported_with_its_place(ros: Any, capfd: pytest.CaptureFixture[str]) -> None:
    publisher = ros.node().create_publisher(Int32, "t", 10)
    with pytest.raises(TypeError, match="field 'data' of std_msgs/msg/Int32 must be"):
        publisher.publish(Int32(data="five", check_fields=False))
    assert "test_publisher_subscription.py:" in capfd.readouterr().err


@pytest.mark.parametrize("kind", [Trigger, int, "std_msgs/String"])
def test_only_message_types_are_accepted(ros: Any, kind: Any) -> None:
    node = ros.node()
    with pytest.raises((RuntimeError, AttributeError, TypeError)):
        node.create_publisher(kind, "t", 10)
    with pytest.raises((RuntimeError, AttributeError, TypeError)):
        node.create_subscription(kind, "t", print, 10)


def test_destroyed_publisher_and_subscription_raise_invalid_handle(ros: Any) -> None:
    line = IntegerTopic(ros)
    subscription = line.subscribe()
    line.send(1)
    assert line.node.destroy_subscription(subscription) and not line.node.destroy_subscription(subscription)
    assert line.arrived() == []
    assert line.node.destroy_publisher(line.publisher) and not line.node.destroy_publisher(line.publisher)
    for use in (lambda: line.send(1), line.publisher.get_subscription_count, lambda: subscription.topic_name):
        with pytest.raises(InvalidHandle, match=DESTROYED):
            use()


def test_publishing_after_shutdown_raises_an_error(ros: Any) -> None:
    line = IntegerTopic(ros)
    ros.context.shutdown()
    with pytest.raises(RCLError, match="Failed to publish: publisher's context is invalid"):
        line.send(1)
    with pytest.raises(RCLError, match="Failed to create publisher: rcl node's context is invalid"):
        line.node.create_publisher(Int32, "u", 1)
    with pytest.raises(RCLError, match="Failed to create subscription: rcl node's context is invalid"):
        line.subscribe()


def test_names_are_expanded_and_remapped(ros: Any) -> None:
    ros.init("-r", "t:=elsewhere")
    node = ros.node(namespace="/ns")
    publisher = node.create_publisher(Int32, "t", 1)
    subscription = node.create_subscription(Int32, "~/t", print, 1)
    assert (publisher.topic, publisher.topic_name) == ("t", "/ns/elsewhere")
    assert (subscription.topic, subscription.topic_name) == ("~/t", "/ns/n/t")


def test_matched_endpoints_are_counted(ros: Any) -> None:
    line = IntegerTopic(ros)
    assert line.publisher.get_subscription_count() == 0
    subscription = line.subscribe()
    line.node.create_subscription(Int32, "t", print, QoSProfile(depth=1, durability=LATCHED))
    assert (line.publisher.get_subscription_count(), line.node.count_subscribers("t")) == (1, 2)
    assert subscription.get_publisher_count() == 1
    line.node.destroy_publisher(line.publisher)
    assert subscription.get_publisher_count() == 0


def test_matched_events_report_counts(ros: Any) -> None:
    node, got = ros.node(), []

    def report(side: str) -> Any:
        return lambda info: got.append(
            (side, info.total_count, info.total_count_change, info.current_count, info.current_count_change)
        )

    node.create_publisher(Int32, "t", 1, event_callbacks=PublisherEventCallbacks(matched=report("publisher")))
    events = SubscriptionEventCallbacks(matched=report("subscription"))
    subscription = node.create_subscription(Int32, "t", print, 1, event_callbacks=events)
    ros.settle()
    assert sorted(got) == [("publisher", 1, 1, 1, 1), ("subscription", 1, 1, 1, 1)]
    got.clear()
    node.destroy_subscription(subscription)
    ros.settle()
    assert got == [("publisher", 1, 0, 0, -1)]


def test_incompatible_qos_warns_both_sides(ros: Any, capfd: pytest.CaptureFixture[str]) -> None:
    line = IntegerTopic(ros, QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT))
    line.subscribe()
    ros.settle()
    words = capfd.readouterr().err
    assert (
        "New subscription discovered on topic 't', requesting incompatible QoS. No messages will be sent to it. "
        "Last incompatible policy: RELIABILITY" in words
    )
    assert (
        "New publisher discovered on topic 't', offering incompatible QoS. No messages will be received from it. "
        "Last incompatible policy: RELIABILITY" in words
    )
