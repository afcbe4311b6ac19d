"""CDR: known bytes, alignment and invalid data."""

from __future__ import annotations

from typing import Any

import pytest
from bot_console.runtime.rosidl.cdr import CdrError, deserialize, serialize
from bot_console.runtime.rosidl.cdr_read import fixed
from bot_console.runtime.rosidl.conversion import FieldTypeError
from example_interfaces.msg import WString
from example_interfaces.srv import AddTwoInts
from geometry_msgs.msg import Point, PoseWithCovariance, Vector3
from rcl_interfaces.msg import ListParametersResult, ParameterValue
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Empty, Float64MultiArray, String
from std_srvs.srv import Trigger

KNOWN = [
    (String(data="hi"), "0001 0000 0300 0000 6869 00"),
    (String(data="ä"), "0001 0000 0300 0000 c3a4 00"),
    (String(), "0001 0000 0100 0000 00"),
    (Empty(), "0001 0000 00"),
    (Trigger.Request(), "0001 0000 00"),
    (Vector3(x=1.0), "0001 0000" + "000000000000f03f" + "00" * 16),
    (AddTwoInts.Request(a=1, b=-1), "0001 0000 0100000000000000 ffffffffffffffff"),
    (WString(data="aä"), "0001 0000 02000000 61000000 e4000000"),
    (WString(data="😀"), "0001 0000 02000000 3dd80000 00de0000"),
    # An empty sequence of 8-byte numbers is not followed by padding.
    (Float64MultiArray(), "0001 0000 00000000 00000000 00000000"),
    (Float64MultiArray(data=[1.0]), "0001 0000 00000000 00000000 01000000 00000000 000000000000f03f"),
]


@pytest.mark.parametrize(("message", "digits"), KNOWN)
def test_messages_have_known_bytes(message: Any, digits: str) -> None:
    assert serialize(message) == bytes.fromhex(digits)
    assert deserialize(bytes.fromhex(digits), type(message)) == message


def test_received_array_of_64_bit_integers_prints_like_a_new_one() -> None:
    assert repr(fixed(bytes(16), 0, 2, "<q", 16)) == "array([0, 0])"


def test_deserialized_messages_are_mutable() -> None:
    scan = deserialize(serialize(LaserScan(ranges=[1.0])), LaserScan)
    scan.ranges.append(2.0)
    pose = deserialize(serialize(PoseWithCovariance()), PoseWithCovariance)
    pose.covariance[0] = 2.0
    assert (list(scan.ranges), pose.covariance[0]) == ([1.0, 2.0], 2.0)


def test_sequence_types_survive_a_round_trip() -> None:
    value = ParameterValue(
        bool_array_value=[True], byte_array_value=[b"a"], double_array_value=[1.0], string_array_value=["x", ""]
    )
    read = deserialize(serialize(value), ParameterValue)
    assert repr(read) == repr(value)


def test_big_endian_is_read() -> None:
    assert deserialize(bytes.fromhex("0000 0000 00000003 686900"), String).data == "hi"
    data = bytes.fromhex("0000 0000 00000000 00000000 00000001 00000000 3ff0000000000000")
    assert deserialize(data, Float64MultiArray).data[0] == 1.0


def test_any_buffer_is_read() -> None:
    data = serialize(Point(x=2.0))
    assert deserialize(memoryview(data), Point) == deserialize(bytearray(data), Point) == Point(x=2.0)


@pytest.mark.parametrize(
    ("digits", "words"),
    [
        ("", "no CDR header of version 1: no data"),
        ("0003 0000 00", "no CDR header of version 1: 00 03 00 00"),
        ("0001 0000", "4 bytes are too few for a String"),
        ("0001 0000 ffffffff 61", "no String: 4294967295 elements cannot be in the 1 bytes that are left"),
    ],
)
def test_invalid_data_is_rejected(digits: str, words: str) -> None:
    with pytest.raises(CdrError) as caught:
        deserialize(bytes.fromhex(digits), String)
    assert str(caught.value).startswith(words)


def test_invalid_utf_8_is_replaced_as_in_rclpy() -> None:
    assert deserialize(bytes.fromhex("0001 0000 04000000 61ff6200"), String).data == "a\ufffdb"
    names = bytes.fromhex("0001 0000 01000000 03000000 ff620000 00000000")
    assert deserialize(names, ListParametersResult).names == ["\ufffdb"]


def test_field_of_wrong_type_is_rejected_by_name() -> None:
    with pytest.raises(FieldTypeError, match="field 'x' of geometry_msgs/msg/Vector3 must be a float"):
        serialize(Vector3(x=1))
