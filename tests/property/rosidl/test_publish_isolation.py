"""Changes to a message after publishing are not visible elsewhere, neither to nor between subscriptions."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import pytest
import rclpy
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import JointState

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
LIMITS = settings(max_examples=20, deadline=None, suppress_health_check=list(HealthCheck))


@pytest.fixture(scope="module")
def executor() -> Iterator[Any]:
    context = rclpy.Context()
    rclpy.init(args=[], context=context)
    executor = SingleThreadedExecutor(context=context)
    node = rclpy.create_node("isolation", context=context)
    executor.add_node(node)
    yield executor
    executor.shutdown()
    node.destroy_node()
    rclpy.try_shutdown(context=context)


def spoil(message: JointState) -> None:
    message.header.frame_id = "spoilt"
    message.header.stamp.sec = 42
    message.name.append("spoilt")
    message.position.append(42.0)
    for index in range(len(message.effort)):
        message.effort[index] = 42.0


def serve(executor: Any, done: Callable[[], bool]) -> None:
    """Serve ready entities until `done` is true; waking the executor may take an extra turn."""
    for _ in range(20):
        if done():
            return
        executor.spin_once(timeout_sec=0.0)


@given(data=st.data())
@LIMITS
def test_every_subscription_receives_what_was_published(executor: Any, messages: Any, data: Any) -> None:
    (node,) = executor.get_nodes()
    publisher = node.create_publisher(JointState, "t", LATCHED)
    message = data.draw(messages.of(JointState))
    wanted = message._copy_()
    got: list[JointState] = []

    def receive(received: JointState) -> None:
        got.append(received._copy_())
        spoil(received)

    subscriptions = [node.create_subscription(JointState, "t", receive, LATCHED) for _ in range(2)]
    publisher.publish(message)
    spoil(message)
    serve(executor, lambda: len(got) == 2)
    late = node.create_subscription(JointState, "t", receive, LATCHED)
    serve(executor, lambda: len(got) == 3)
    for each in (*subscriptions, late):
        node.destroy_subscription(each)
    node.destroy_publisher(publisher)
    assert len(got) == 3
    assert all(messages.same(each, wanted) for each in got)
