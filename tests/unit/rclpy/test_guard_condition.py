"""Guard conditions, and waiting for one message."""

from __future__ import annotations

import threading
from typing import Any

import pytest
from rclpy._rclpy_pybind11 import InvalidHandle
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.wait_for_message import wait_for_message
from std_msgs.msg import Int32


def test_repeated_triggers_call_back_once_per_wake(ros: Any) -> None:
    node, got = ros.node(), []
    guard = node.create_guard_condition(lambda: got.append(1))
    for _ in range(3):
        guard.trigger()
    ros.settle()
    guard.trigger()
    ros.settle()
    assert got == [1, 1]


def test_guard_condition_may_be_triggered_in_its_own_callback(ros: Any) -> None:
    node, got = ros.node(), []

    def again() -> None:
        got.append(1)
        if len(got) < 3:
            guard.trigger()

    guard = node.create_guard_condition(again)
    guard.trigger()
    ros.spin(lambda: len(got) >= 3)


def test_trigger_wakes_another_thread(ros: Any) -> None:
    node, got = ros.node(), threading.Event()
    guard = node.create_guard_condition(got.set)
    thread = threading.Thread(target=node.executor.spin, daemon=True)
    thread.start()
    guard.trigger()
    assert got.wait(240.0)
    node.executor.shutdown()
    thread.join(240.0)
    assert not thread.is_alive()


def test_callback_may_be_a_coroutine(ros: Any) -> None:
    node, got = ros.node(), []

    async def act() -> None:
        got.append(1)

    node.create_guard_condition(act).trigger()
    ros.spin(lambda: bool(got))


def test_destroyed_guard_condition_raises_invalid_handle(ros: Any) -> None:
    node = ros.node()
    guard = node.create_guard_condition(None)
    guard.trigger()
    assert node.destroy_guard_condition(guard) and not node.destroy_guard_condition(guard)
    with pytest.raises(InvalidHandle):
        guard.trigger()


def test_wait_for_message_returns_the_message(stepped_ros: Any) -> None:
    node = stepped_ros.node()
    publisher = node.create_publisher(Int32, "t", 1)
    threading.Timer(0.5, lambda: publisher.publish(Int32(data=7))).start()
    assert wait_for_message(Int32, node, "t", time_to_wait=5.0) == (True, Int32(data=7))
    assert node.count_subscribers("t") == 0


def test_wait_for_message_times_out(stepped_ros: Any) -> None:
    node = stepped_ros.node()
    start = node.get_clock().now()
    assert wait_for_message(Int32, node, "t", time_to_wait=0.5) == (False, None)
    assert (node.get_clock().now() - start).nanoseconds == 500_000_000


def test_wait_for_message_returns_a_latched_message(ros: Any) -> None:
    node = ros.node()
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    node.create_publisher(Int32, "t", latched).publish(Int32(data=3))
    assert wait_for_message(Int32, node, "t", qos_profile=latched) == (True, Int32(data=3))
