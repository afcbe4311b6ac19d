"""Messages as YAML, CSV and dictionaries."""

from __future__ import annotations

from collections import OrderedDict

from geometry_msgs.msg import PoseWithCovariance, Vector3
from rcl_interfaces.msg import ParameterDescriptor, ParameterValue
from rosidl_parser.definition import BasicType, UnboundedString
from rosidl_runtime_py import get_message_slot_types, message_to_csv, message_to_ordereddict, message_to_yaml
from sensor_msgs.msg import Image, JointState, LaserScan
from std_msgs.msg import Byte, Float64MultiArray, Header, String

HEADER = "header:\n  stamp:\n    sec: 0\n    nanosec: 0\n  frame_id: ''\n"


def test_yaml_keeps_the_order_of_the_fields() -> None:
    assert message_to_yaml(Vector3(z=1.0)) == "x: 0.0\ny: 0.0\nz: 1.0\n"
    assert message_to_yaml(JointState(name=["a"])) == f"{HEADER}name:\n- a\nposition: []\nvelocity: []\neffort: []\n"


def test_flow_style_applies_to_nested_values_only() -> None:
    message = JointState(position=[0.5, float("inf")])
    assert message_to_yaml(message, flow_style=True).splitlines()[-3:] == [
        "position: [0.5, .inf]",
        "velocity: []",
        "effort: []",
    ]


def test_strings_and_sequences_are_truncated() -> None:
    assert message_to_yaml(String(data="abcdef"), truncate_length=3) == "data: abc...\n"
    scan = LaserScan(ranges=[1.0, 2.0, 3.0])
    assert "ranges:\n- 1.0\n- 2.0\n- '...'\n" in message_to_yaml(scan, truncate_length=2)
    assert message_to_csv(scan, truncate_length=2).endswith("1.0,2.0,...,")


def test_sequences_and_strings_can_be_left_out() -> None:
    value = ParameterValue(string_value="abc", integer_array_value=[1, 2], string_array_value=["a"])
    fields = message_to_ordereddict(value, no_arr=True, no_str=True)
    assert fields["string_value"] == "<string length: <3>>"
    assert fields["integer_array_value"] == "<sequence type: int64, length: 2>"
    assert fields["string_array_value"] == "<sequence type: string, length: 1>"
    assert message_to_ordereddict(PoseWithCovariance(), no_arr=True)["covariance"] == "<array type: double[36]>"
    shown = message_to_ordereddict(ParameterDescriptor(), no_arr=True)["integer_range"]
    assert shown == "<sequence type: rcl_interfaces/msg/IntegerRange[1], length: 0>"


def test_bytes_become_text() -> None:
    assert message_to_ordereddict(Byte(data=b"A"))["data"] == "A"
    assert message_to_ordereddict(ParameterValue(byte_array_value=[b"a"]))["byte_array_value"] == ["a"]


def test_csv_is_flat() -> None:
    assert message_to_csv(Header(frame_id="map")) == "0,0,map"
    assert message_to_csv(Image(width=1, data=[1, 2])) == "0,0,,0,1,,0,0,1,2"


def test_dictionaries_hold_plain_python_values() -> None:
    fields = message_to_ordereddict(PoseWithCovariance())
    assert isinstance(fields, OrderedDict)
    assert type(fields["covariance"]) is list
    assert type(fields["covariance"][0]) is float
    assert list(fields["pose"]) == ["position", "orientation"]


def test_slot_types_are_returned_by_name() -> None:
    assert get_message_slot_types(String()) == {"data": UnboundedString()}
    assert get_message_slot_types(Vector3)["x"] == BasicType("double")


def test_empty_array_at_the_start_of_csv_adds_no_comma() -> None:
    assert message_to_csv(Float64MultiArray()) == "0,"
    assert message_to_csv(Float64MultiArray(data=[1.0])) == "0,1.0"
