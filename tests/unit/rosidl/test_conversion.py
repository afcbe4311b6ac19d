"""Copies of messages whose fields hold values of other types than those defined."""

from __future__ import annotations

from typing import Any

import numpy
import pytest
from bot_console.runtime.rosidl.conversion import FieldTypeError
from geometry_msgs.msg import Point, Polygon, Twist, Vector3
from rcl_interfaces.msg import ParameterDescriptor, ParameterValue
from sensor_msgs.msg import Imu, JointState
from std_msgs.msg import Bool, Byte, Float32, Int8, String
from tf2_msgs.msg import TFMessage


def refusal_of(message: Any) -> str:
    with pytest.raises(FieldTypeError) as caught:
        message._copy_()
    return str(caught.value)


def test_error_names_the_nested_field() -> None:
    twist = Twist()
    twist.linear.x = 1
    assert refusal_of(twist) == "field 'linear.x' of geometry_msgs/msg/Twist must be a float, not int (1)"


def test_error_path_leads_into_a_sequence() -> None:
    tree = TFMessage()
    from geometry_msgs.msg import TransformStamped

    tree.transforms = [TransformStamped(), TransformStamped()]
    tree.transforms[1].transform.rotation.w = "one"
    text = refusal_of(tree)
    assert text.startswith("field 'transforms[1].transform.rotation.w' of tf2_msgs/msg/TFMessage must be a float")


@pytest.mark.parametrize(
    ("message", "words"),
    [
        (Int8(data=128), "field 'data' of std_msgs/msg/Int8 must be an integer in [-128, 127], not int (128)"),
        (Int8(data=1.0), "field 'data' of std_msgs/msg/Int8 must be an integer, not float (1.0)"),
        (Bool(data=1), "field 'data' of std_msgs/msg/Bool must be a bool, not int (1)"),
        (String(data=None), "field 'data' of std_msgs/msg/String must be a string, not NoneType (None)"),
        (Byte(data=5), "field 'data' of std_msgs/msg/Byte must be bytes of length 1, not int (5)"),
        (JointState(name=["a", 2]), "field 'name[1]' of sensor_msgs/msg/JointState must be a string, not int (2)"),
        (Twist(linear=Point()), "must be a geometry_msgs/msg/Vector3, not Point"),
        (Polygon(points=5), "field 'points' of geometry_msgs/msg/Polygon must be a sequence, not int (5)"),
        (ParameterDescriptor(integer_range=[1, 2]), "must be a sequence of at most 1"),
    ],
)
def test_values_that_cannot_be_sent_are_rejected(message: Any, words: str) -> None:
    assert words in refusal_of(message)


def test_fixed_array_of_wrong_length_is_rejected() -> None:
    Imu()._copy_()  # after the first valid message there is a faster path
    message = Imu()
    message.orientation_covariance = [0.0] * 8
    assert "must be a sequence of exactly 9" in refusal_of(message)


def test_fixed_array_is_copied_each_time() -> None:
    message = Imu()
    copies = [message._copy_() for _ in range(3)]
    message.orientation_covariance[0] = 1.0
    copies[0].orientation_covariance[1] = 2.0
    assert [each.orientation_covariance[:2].tolist() for each in copies] == [[0.0, 2.0], [0.0, 0.0], [0.0, 0.0]]
    assert {each.orientation_covariance.dtype for each in copies} == {numpy.dtype("float64")}


def test_numpy_numbers_become_python_numbers() -> None:
    copy = Vector3(x=numpy.float64(1.5))._copy_()
    assert type(copy.x) is float
    assert type(Int8(data=numpy.int64(5))._copy_().data) is int
    assert Bool(data=numpy.bool_(True))._copy_().data is True


def test_bool_counts_as_an_integer() -> None:
    assert Int8(data=True)._copy_().data == 1


def test_float32_is_rounded_and_float64_is_not() -> None:
    assert Float32(data=0.1)._copy_().data == 0.10000000149011612
    assert Vector3(x=0.1)._copy_().x == 0.1


def test_bytes_become_a_list_of_bytes() -> None:
    assert ParameterValue(byte_array_value=b"ab")._copy_().byte_array_value == [b"a", b"b"]


def test_tuple_of_messages_becomes_a_list() -> None:
    from geometry_msgs.msg import Point32

    copy = Polygon(points=(Point32(x=1.0),))._copy_()
    assert copy.points == [Point32(x=1.0)]


class Unwritable:
    def __repr__(self) -> str:
        raise RuntimeError("not even this")


@pytest.mark.parametrize("value", [Unwritable(), [16**5000]], ids=["own", "endless"])
def test_value_without_a_working_repr_is_reported(value: object) -> None:
    assert refusal_of(Bool(data=value)).endswith("(which cannot be written)")
