"""Changes to a message after publishing, by the sender or by a receiver, are never visible elsewhere."""

from __future__ import annotations

import copy
from array import array
from typing import Any

from geometry_msgs.msg import Point, Pose, PoseArray, PoseWithCovariance
from hypothesis import given
from hypothesis import strategies as st
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import JointState, LaserScan
from serving import serving
from std_msgs.msg import Header, UInt8MultiArray

floats = st.floats(allow_nan=False, allow_infinity=False, width=32)
texts = st.text(alphabet="abc é", max_size=5)
headers = st.builds(Header, frame_id=texts)
points = st.builds(Point, x=floats, y=floats, z=floats)
messages = st.one_of(
    st.builds(LaserScan, header=headers, ranges=st.lists(floats, max_size=4), angle_min=floats),
    st.builds(JointState, header=headers, name=st.lists(texts, max_size=3), position=st.lists(floats, max_size=3)),
    st.builds(PoseArray, header=headers, poses=st.lists(st.builds(Pose, position=points), max_size=3)),
    st.builds(UInt8MultiArray, data=st.binary(max_size=5).map(lambda data: array("B", data))),
    st.builds(PoseWithCovariance, pose=st.builds(Pose, position=points)),
)


def spoil(value: Any) -> None:
    """Change everything in a value that can be changed in place, recursively."""
    if hasattr(value, "get_fields_and_field_types"):
        for field in value.get_fields_and_field_types():
            inner = getattr(value, field)
            spoil(inner)
            if isinstance(inner, str):
                setattr(value, field, inner + "!")
            elif isinstance(inner, float):
                setattr(value, field, inner + 1.0)
    elif isinstance(value, (list, array)):
        for each in value:
            spoil(each)
        value.extend(value)
        del value[: len(value) // 2 - 1]
    elif hasattr(value, "fill"):
        value.fill(7.0)


def full_text(message: Any) -> str:
    """The whole message as text; upstream's `==` misses some differences of fixed-size arrays."""
    return repr(message)


@given(messages)
def test_the_sender_may_change_its_message_at_once(message: Any) -> None:
    before, got = full_text(copy.deepcopy(message)), []
    with serving() as (node, executor):
        node.create_subscription(type(message), "t", got.append, 10)
        node.create_publisher(type(message), "t", 10).publish(message)
        spoil(message)
        executor.spin_once(timeout_sec=5.0)
    assert full_text(got[0]) == before


@given(messages)
def test_a_receiver_may_change_its_message(message: Any) -> None:
    before, got = full_text(message), []

    def take(received: Any) -> None:
        got.append(full_text(received))
        spoil(received)

    with serving() as (node, executor):
        for _ in range(2):
            node.create_subscription(type(message), "t", take, 10)
        node.create_publisher(type(message), "t", 10).publish(message)
        for _ in range(2):
            executor.spin_once(timeout_sec=5.0)
    assert got == [before, before]
    assert full_text(message) == before


@given(messages)
def test_messages_kept_for_late_subscriptions_are_copies(message: Any) -> None:
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    before, got = full_text(copy.deepcopy(message)), []

    def take(received: Any) -> None:
        got.append(full_text(received))
        spoil(received)

    with serving() as (node, executor):
        node.create_publisher(type(message), "t", latched).publish(message)
        spoil(message)
        for _ in range(2):
            node.create_subscription(type(message), "t", take, latched)
            executor.spin_once(timeout_sec=5.0)
    assert got == [before, before]
