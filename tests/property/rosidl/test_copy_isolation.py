"""A copy equals the result of a CDR round trip, and shares nothing with the original message."""

from __future__ import annotations

import importlib
from array import array
from typing import Any

import numpy
import pytest
from bot_console.runtime.rosidl.cdr import deserialize, serialize
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from sampling import slow_after

NAMES = (
    "std_msgs/msg/Float32",
    "std_msgs/msg/Float64MultiArray",
    "geometry_msgs/msg/PoseWithCovarianceStamped",
    "sensor_msgs/msg/LaserScan",
    "sensor_msgs/msg/CameraInfo",
    "sensor_msgs/msg/JointState",
    "rcl_interfaces/msg/ParameterEvent",
    "tf2_msgs/msg/TFMessage",
)
A_FEW = settings.default.max_examples * 2 // 5
"""Fewer examples: each covers all fields of a message, and there are many messages."""
LIMITS = settings(max_examples=A_FEW, deadline=None, suppress_health_check=list(HealthCheck))


def class_of(name: str) -> Any:
    package, kind, short = name.split("/")
    return getattr(importlib.import_module(f"{package}.{kind}"), short)


def parts(value: Any) -> list[Any]:
    """All mutable objects inside a message, including itself."""
    if hasattr(value, "get_fields_and_field_types"):
        inside = [getattr(value, each) for each in value.get_fields_and_field_types()]
        return [value, *(part for each in inside for part in parts(each))]
    if isinstance(value, list):
        return [value, *(part for each in value for part in parts(each))]
    return [value] if isinstance(value, (array, numpy.ndarray)) else []


@pytest.mark.parametrize("name", slow_after(3, NAMES))
@given(data=st.data())
@LIMITS
def test_a_copy_equals_the_result_of_a_round_trip(name: str, data: Any, messages: Any) -> None:
    message = data.draw(messages.of(class_of(name)))
    assert messages.same(message._copy_(), deserialize(serialize(message), type(message)))


@pytest.mark.parametrize("name", slow_after(3, NAMES))
@given(data=st.data())
@LIMITS
def test_a_copy_shares_no_part_with_the_message(name: str, data: Any, messages: Any) -> None:
    message = data.draw(messages.of(class_of(name)))
    copy = message._copy_()
    assert not {id(each) for each in parts(message)} & {id(each) for each in parts(copy)}
    arrays = (array, numpy.ndarray)
    ours = [each for each in parts(message) if isinstance(each, arrays)]
    theirs = [each for each in parts(copy) if isinstance(each, arrays)]
    for one, other in zip(ours, theirs, strict=True):
        before = other.tobytes()
        for index in range(len(one)):
            one[index] = 1
        assert other.tobytes() == before
