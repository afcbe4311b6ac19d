"""CDR: written messages are read back unchanged, and their bytes are identical to those of rosbags."""

from __future__ import annotations

import importlib
from typing import Any

import pytest
from bot_console.runtime.rosidl.cdr import CdrError, deserialize, serialize
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

LARGE = (
    "trajectory_msgs/msg/JointTrajectory",
    "visualization_msgs/msg/Marker",
    "rcl_interfaces/msg/ParameterEvent",
    "sensor_msgs/msg/PointCloud2",
    "rcl_interfaces/msg/ParameterDescriptor",
    "sensor_msgs/msg/BatteryState",
    "diagnostic_msgs/msg/DiagnosticArray",
    "tf2_msgs/msg/TFMessage",
)
"""The messages with the most fields; smaller messages contain the same kinds."""
NAMES = (
    "std_msgs/msg/Empty",
    "std_msgs/msg/String",
    "std_msgs/msg/ByteMultiArray",
    "std_msgs/msg/UInt8MultiArray",
    "geometry_msgs/msg/TwistStamped",
    "geometry_msgs/msg/PoseWithCovarianceStamped",
    "sensor_msgs/msg/LaserScan",
    "sensor_msgs/msg/Imu",
    "sensor_msgs/msg/BatteryState",
    "sensor_msgs/msg/JointState",
    "sensor_msgs/msg/PointCloud2",
    "nav_msgs/msg/OccupancyGrid",
    "tf2_msgs/msg/TFMessage",
    "rcl_interfaces/msg/ParameterEvent",
    "rcl_interfaces/msg/ParameterDescriptor",
    "trajectory_msgs/msg/JointTrajectory",
    "visualization_msgs/msg/Marker",
    "diagnostic_msgs/msg/DiagnosticArray",
    "unique_identifier_msgs/msg/UUID",
)
A_FEW = settings.default.max_examples * 2 // 5
"""Fewer examples: each covers all fields of a message, and there are many messages."""
LIMITS = settings(max_examples=A_FEW, deadline=None, suppress_health_check=list(HealthCheck))


def class_of(name: str) -> Any:
    package, kind, short = name.split("/")
    return getattr(importlib.import_module(f"{package}.{kind}"), short)


@pytest.mark.parametrize(
    "name",
    [
        pytest.param(each, marks=pytest.mark.slow) if each in LARGE else each
        for each in [*NAMES, "example_interfaces/msg/WString"]
    ],
)
@given(data=st.data())
@LIMITS
def test_written_messages_are_read_back_unchanged(name: str, data: Any, messages: Any) -> None:
    message = data.draw(messages.of(class_of(name)))
    written = serialize(message)
    read = deserialize(written, type(message))
    assert messages.same(read, message._copy_())
    assert serialize(read) == written


@pytest.fixture(scope="session")
def store() -> Any:
    from rosbags.typesys import Stores, get_typestore

    return get_typestore(Stores.ROS2_JAZZY)


@pytest.mark.parametrize(
    "name", [pytest.param(each, marks=pytest.mark.slow) if each in LARGE else each for each in NAMES]
)
@given(data=st.data())
@LIMITS
def test_the_bytes_are_identical_to_those_of_rosbags(name: str, data: Any, messages: Any, store: Any) -> None:
    message = data.draw(messages.of(class_of(name)))
    theirs = bytes(store.serialize_cdr(messages.for_rosbags(message), name))
    assert serialize(message) == theirs


@given(data=st.data())
@LIMITS
def test_broken_bytes_are_refused_or_read_without_other_errors(data: Any, messages: Any) -> None:
    cls = class_of(data.draw(st.sampled_from(NAMES)))
    written = bytearray(serialize(data.draw(messages.of(cls))))
    cut = data.draw(st.integers(0, len(written)))
    for place, value in data.draw(st.lists(st.tuples(st.integers(4, 80), st.integers(0, 255)), max_size=4)):
        if place < len(written):
            written[place] = value
    try:
        assert isinstance(deserialize(bytes(written[:cut]), cls), cls)
    except CdrError as error:
        assert str(error)
