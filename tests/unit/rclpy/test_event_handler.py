"""QoS events: deadlines, liveliness, matches over time."""

from __future__ import annotations

from typing import Any

import pytest
from rclpy.clock import Clock
from rclpy.duration import Duration, Infinite
from rclpy.event_handler import (
    PublisherEventCallbacks,
    QoSRequestedIncompatibleQoSInfo,
    SubscriptionEventCallbacks,
)
from rclpy.executors import SingleThreadedExecutor
from rclpy.impl.event_handlers import IncompatibleHandler
from rclpy.qos import LivelinessPolicy, QoSPolicyKind, QoSProfile
from std_msgs.msg import Int32

SECOND = 1_000_000_000


class Events:
    """Events of a publisher and a subscription on one topic, with the time (ms) since the start."""

    def __init__(self, ros: Any, **policies: Any) -> None:
        self.node = ros.node()
        self.qos = QoSProfile(depth=10, **policies)
        self.heard: list[tuple[Any, ...]] = []
        self._clock = Clock()
        self._start = self._clock.now()
        self._end = self._start

    def hear(self, name: str) -> Any:
        """Return a callback that records events under a name."""

        def callback(info: Any) -> None:
            elapsed = (self._clock.now() - self._start).nanoseconds // 1_000_000
            self.heard.append((elapsed, name, *info))

        return callback

    def publisher(self, **callbacks: Any) -> Any:
        """A publisher."""
        events = PublisherEventCallbacks(**callbacks)
        return self.node.create_publisher(Int32, "t", self.qos, event_callbacks=events)

    def subscription(self, **callbacks: Any) -> Any:
        """A subscription."""
        events = SubscriptionEventCallbacks(**callbacks)
        return self.node.create_subscription(Int32, "t", lambda message: None, self.qos, event_callbacks=events)

    def run(self, seconds: float) -> None:
        """Spin the node for some time (s)."""
        self._end += Duration(seconds=seconds)
        while self._clock.now() < self._end:
            self.node.executor.spin_once(timeout_sec=(self._end - self._clock.now()).nanoseconds / SECOND)


def test_deadlines_are_missed_repeatedly_after_the_first_message(stepped_ros: Any) -> None:
    events = Events(stepped_ros, deadline=Duration(seconds=0.5))
    events.subscription(deadline=events.hear("requested"))
    publisher = events.publisher(deadline=events.hear("offered"))
    events.run(1.0)
    assert events.heard == []
    publisher.publish(Int32())
    events.run(0.4)
    publisher.publish(Int32())
    events.run(1.2)
    assert sorted(events.heard) == [
        (1900, "offered", 1, 1),
        (1900, "requested", 1, 1),
        (2400, "offered", 2, 1),
        (2400, "requested", 2, 1),
    ]


@pytest.mark.parametrize("deadline", [Duration(), Infinite])
def test_infinite_deadline_is_never_missed(stepped_ros: Any, deadline: Duration) -> None:
    events = Events(stepped_ros, deadline=deadline)
    events.subscription(deadline=events.hear("requested"))
    events.publisher(deadline=events.hear("offered")).publish(Int32())
    events.run(100.0)
    assert events.heard == []


def test_automatic_liveliness_follows_the_publishers_existence(stepped_ros: Any) -> None:
    events = Events(stepped_ros, liveliness=LivelinessPolicy.AUTOMATIC, liveliness_lease_duration=Duration(seconds=1))
    events.subscription(liveliness=events.hear("changed"))
    publisher = events.publisher(liveliness=events.hear("lost"))
    events.run(5.0)
    events.node.destroy_publisher(publisher)
    events.run(1.0)
    assert events.heard == [(0, "changed", 1, 0, 1, 0), (5000, "changed", 0, 0, -1, 0)]


def test_manual_liveliness_is_lost_and_regained(stepped_ros: Any) -> None:
    events = Events(
        stepped_ros, liveliness=LivelinessPolicy.MANUAL_BY_TOPIC, liveliness_lease_duration=Duration(seconds=1)
    )
    events.subscription(liveliness=events.hear("changed"))
    publisher = events.publisher(liveliness=events.hear("lost"))
    events.run(0.5)
    publisher.assert_liveliness()
    events.run(2.5)
    publisher.publish(Int32())
    events.run(0.5)
    assert sorted(events.heard) == [
        (0, "changed", 1, 0, 1, 0),
        (1500, "changed", 0, 1, -1, 1),
        (1500, "lost", 1, 1),
        (3000, "changed", 1, 0, 1, -1),
    ]


def test_changes_accumulate_until_reported(ros: Any) -> None:
    events = Events(ros)
    events.publisher(matched=events.hear("matched"))
    executor = events.node.executor
    executor.remove_node(events.node)
    made = [events.subscription() for _ in range(3)]
    events.node.destroy_subscription(made[0])
    executor.add_node(events.node)
    ros.settle()
    assert [each[1:] for each in events.heard] == [("matched", 3, 3, 2, 2)]


def test_default_callbacks_can_be_disabled(ros: Any) -> None:
    publisher = Events(ros).publisher(use_default_callbacks=False)
    assert publisher.event_handlers == []


def test_events_are_served_by_the_executor_of_their_node(stepped_ros: Any) -> None:
    events = Events(stepped_ros, deadline=Duration(seconds=0.5))
    events.subscription(deadline=events.hear("requested"))
    publisher = events.publisher()
    publisher.publish(Int32())
    other = SingleThreadedExecutor(context=events.node.context)
    other.add_node(events.node)
    events.run(0.7)
    assert [each[1:] for each in events.heard] == [("requested", 1, 1)]
    other.remove_node(events.node)


def test_incompatible_policy_prints_its_name() -> None:
    heard: list[QoSRequestedIncompatibleQoSInfo] = []
    handler = IncompatibleHandler(QoSRequestedIncompatibleQoSInfo, heard.append, None)
    handler.on_event("incompatible", "RELIABILITY")
    handler.run()
    (info,) = heard
    assert str(info.last_policy_kind) == "rmw_qos_policy_kind_t.RMW_QOS_POLICY_RELIABILITY"
    assert info.last_policy_kind == QoSPolicyKind.RELIABILITY
