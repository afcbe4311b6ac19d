"""Messages filled from plain values."""

from __future__ import annotations

from array import array
from typing import Any

import pytest
from builtin_interfaces.msg import Time
from geometry_msgs.msg import Point32, Polygon, PoseWithCovariance, TwistStamped
from rcl_interfaces.srv import SetParameters
from rosidl_runtime_py import set_message_fields
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Header, Int32, String


def fill(message: Any, values: Any) -> Any:
    assert set_message_fields(message, values) == []
    return message


def test_nested_fields_are_set_and_converted() -> None:
    twist = fill(TwistStamped(), {"header": {"frame_id": "map"}, "twist": {"linear": {"x": 1}}})
    assert (twist.header.frame_id, twist.twist.linear.x) == ("map", 1.0)
    assert fill(Int32(), {"data": "5"}).data == 5
    assert fill(String(), {"data": 5}).data == "5"


def test_sequences_are_set() -> None:
    assert fill(LaserScan(), {"ranges": [1, 2]}).ranges == array("f", [1.0, 2.0])
    assert fill(PoseWithCovariance(), {"covariance": [1] * 36}).covariance.dtype == "float64"
    assert fill(Polygon(), {"points": [{"x": 1.0}]}).points == [Point32(x=1.0)]


def test_nested_sequences_are_set_without_changing_the_values() -> None:
    values = {"parameters": [{"name": "a", "value": {"type": 3, "double_value": 2.0}}]}
    request = fill(SetParameters.Request(), values)
    assert request.parameters[0].value.double_value == 2.0
    assert values["parameters"][0]["name"] == "a"


@pytest.mark.parametrize(
    ("message", "values", "error", "words"),
    [
        (String(), {"foo": 1}, AttributeError, "'String' object has no attribute 'foo'"),
        (Int32(), {"data": "x"}, ValueError, "invalid literal for int() with base 10: 'x'"),
        (String(), "x", TypeError, "Value 'x' is expected to be a dictionary but is a str"),
        (TwistStamped(), {"twist": 5}, TypeError, "Value '5' is expected to be a dictionary but is a int"),
    ],
)
def test_invalid_values_are_rejected(message: Any, values: Any, error: type[Exception], words: str) -> None:
    with pytest.raises(error) as caught:
        set_message_fields(message, values)
    assert str(caught.value) == words


def test_auto_and_now_are_filled_in_later() -> None:
    twist, header = TwistStamped(), Header()
    (stamp,) = set_message_fields(twist, {"header": "auto"}, expand_header_auto=True)
    (now,) = set_message_fields(header, {"stamp": "now"}, expand_time_now=True)
    stamp(Time(sec=5))
    now(Time(sec=6))
    assert (twist.header.stamp.sec, header.stamp.sec) == (5, 6)


def test_now_is_rejected_unless_enabled() -> None:
    with pytest.raises(TypeError, match="Value 'now' is expected to be a dictionary but is a str"):
        set_message_fields(Header(), {"stamp": "now"})
