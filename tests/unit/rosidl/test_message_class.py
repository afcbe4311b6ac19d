"""Generated message classes: constructors, assignment, checks, equality, repr. Error messages are those of Jazzy."""

from __future__ import annotations

import importlib
import pickle
import sys
from array import array
from collections.abc import Iterator

import numpy
import pytest
import std_msgs.msg
from bot_console.runtime.rosidl.conversion import type_name
from bot_console.runtime.rosidl.message import read_checks_again
from diagnostic_msgs.msg import KeyValue
from example_interfaces.action import Fibonacci
from geometry_msgs.msg import PoseWithCovariance, Quaternion, Twist, Vector3
from rcl_interfaces.msg import Log, ParameterDescriptor, ParameterType, ParameterValue
from rcl_interfaces.srv import ListParameters
from rosidl_parser.definition import Array, BasicType, NamespacedType, UnboundedSequence, UnboundedString
from sensor_msgs.msg import Imu, JointState, LaserScan, NavSatStatus
from std_msgs.msg import Bool, Byte, Int8, Int32, String, UInt8
from std_srvs.srv import SetBool, Trigger

FLOATS = "[-340282346600000016151267322115014000640.000000, 340282346600000016151267322115014000640.000000]"
REFUSED = [
    (Vector3, "x", 1, "The 'x' field must be of type 'float'"),
    (Int32, "data", 2**31, "The 'data' field must be an integer in [-2147483648, 2147483647]"),
    (UInt8, "data", -1, "The 'data' field must be an unsigned integer in [0, 255]"),
    (Bool, "data", 1, "The 'data' field must be of type 'bool'"),
    (String, "data", None, "The 'data' field must be of type 'str'"),
    (Byte, "data", b"ab", "The 'data' field must be of type 'bytes' or 'ByteString' with length 1"),
    (Twist, "linear", 5, "The 'linear' field must be a sub message of type 'Vector3'"),
    (LaserScan, "ranges", array("d"), "The 'ranges' array.array() must have the type code of 'f'"),
    (
        LaserScan,
        "ranges",
        5.0,
        f"The 'ranges' field must be a set or sequence and each value of type 'float' and each float in {FLOATS}",
    ),
    (JointState, "name", "ab", "The 'name' field must be a set or sequence and each value of type 'str'"),
    (
        ParameterDescriptor,
        "integer_range",
        [1, 2],
        "The 'integer_range' field must be a set or sequence with length <= 1 and each value of type 'IntegerRange'",
    ),
    (
        Imu,
        "orientation_covariance",
        numpy.zeros(8),
        "The 'orientation_covariance' numpy.ndarray() must have a size of 9",
    ),
    (
        Imu,
        "orientation_covariance",
        numpy.zeros(9, "float32"),
        "The 'orientation_covariance' numpy.ndarray() must have the dtype of 'numpy.float64'",
    ),
]


@pytest.mark.parametrize(("cls", "field", "value", "words"), REFUSED)
def test_checks_reject_an_assignment(cls: type, field: str, value: object, words: str) -> None:
    message = cls(check_fields=True)
    with pytest.raises(AssertionError) as caught:
        setattr(message, field, value)
    assert str(caught.value) == words


def test_any_value_is_kept_without_checks() -> None:
    message = Vector3(x="a")
    message.y = None
    assert (message.x, message.y) == ("a", None)


@pytest.fixture
def checking(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    monkeypatch.setenv("ROS_PYTHON_CHECK_FIELDS", "1")
    yield
    monkeypatch.undo()
    read_checks_again()


def test_environment_enables_checks_until_a_message_is_created(checking: None) -> None:
    read_checks_again()
    with pytest.raises(AssertionError, match="must be of type 'int'"):
        Int8(data="x")


def test_environment_is_read_again_after_importing_a_module(checking: None, monkeypatch: pytest.MonkeyPatch) -> None:
    Int8(check_fields=False)
    monkeypatch.delitem(sys.modules, "example_interfaces.msg._char", raising=False)
    importlib.import_module("example_interfaces.msg._char")
    with pytest.raises(AssertionError, match="must be of type 'int'"):
        Int8(data="x")


def test_unknown_keyword_is_ignored_with_a_warning() -> None:
    with pytest.warns(UserWarning, match="Vector3 has no field named w: the value is ignored") as caught:
        assert Vector3(w=1.0) == Vector3()
    assert caught[0].filename == __file__


def test_unknown_keyword_is_rejected_with_checks() -> None:
    with pytest.raises(AssertionError, match=r"^Invalid arguments passed to constructor: a, w$"):
        Vector3(w=1.0, a=2, check_fields=True)


def test_numeric_arrays_are_copied_on_assignment() -> None:
    ranges, covariance = array("f", [1.0]), numpy.zeros(36)
    scan, pose = LaserScan(ranges=ranges, intensities=ranges), PoseWithCovariance(covariance=covariance)
    scan.ranges = ranges
    ranges[0], covariance[0] = 2.0, 2.0
    assert (scan.ranges[0], scan.intensities[0], pose.covariance[0]) == (1.0, 1.0, 0.0)


def test_array_of_the_right_type_is_kept_itself_with_checks() -> None:
    ranges = array("f", [1.0])
    scan = LaserScan(check_fields=True)
    scan.ranges = ranges
    assert scan.ranges is ranges


def test_fixed_array_of_wrong_length_is_rejected_by_constructor_only() -> None:
    with pytest.raises(AssertionError, match=r"^$"):
        Imu(orientation_covariance=[0.0] * 8)
    message = Imu()
    message.orientation_covariance = [0.0] * 8
    assert message.orientation_covariance.shape == (8,)


def test_messages_share_no_mutable_defaults() -> None:
    one, other = JointState(), JointState()
    one.name.append("a")
    one.position.append(1.0)
    one.header.frame_id = "map"
    assert other == JointState()


def test_fields_have_default_values() -> None:
    assert Quaternion() == Quaternion(x=0.0, y=0.0, z=0.0, w=1.0)
    assert Quaternion.W__DEFAULT == 1.0


def test_constants_are_attributes_of_class_and_instance() -> None:
    assert (ParameterType.PARAMETER_STRING_ARRAY, Log.INFO, ListParameters.Request.DEPTH_RECURSIVE) == (9, 20, 0)
    assert Log().WARN == 30


def test_slots_types_and_fields_are_those_of_rosidl() -> None:
    assert LaserScan.__slots__[-2:] == ["_intensities", "_check_fields"]
    assert JointState.get_fields_and_field_types()["name"] == "sequence<string>"
    assert (
        NamespacedType(["geometry_msgs", "msg"], "Pose"),
        Array(BasicType("double"), 36),
    ) == PoseWithCovariance.SLOT_TYPES
    assert JointState().SLOT_TYPES[1:3] == (
        UnboundedSequence(UnboundedString()),
        UnboundedSequence(BasicType("double")),
    )


def test_fields_dict_is_a_copy() -> None:
    String.get_fields_and_field_types().clear()
    assert String.get_fields_and_field_types() == {"data": "string"}


def test_repr_is_that_of_rosidl() -> None:
    assert repr(LaserScan(ranges=[1.0]).ranges) == "array('f', [1.0])"
    assert "ranges=[1.0], intensities=[])" in repr(LaserScan(ranges=[1.0]))
    assert repr(String(data=array("i", [1]))) == "std_msgs.msg.String(data=array('i', [1]))"
    assert "name=array('d', [1.0]), position=[2.0]" in repr(
        JointState(name=array("d", [1.0]), position=array("d", [2.0]))
    )
    assert repr(SetBool.Request(data=True)) == "std_srvs.srv.SetBool_Request(data=True)"
    assert repr(Fibonacci.Goal(order=3)) == "example_interfaces.action.Fibonacci_Goal(order=3)"


def test_equality_requires_the_same_class() -> None:
    assert String(data="a") == String(data="a") != String(data="b")
    assert SetBool.Request() != Trigger.Request()
    assert Vector3() != (0.0, 0.0, 0.0)


def test_fixed_arrays_are_unequal_only_if_all_elements_differ() -> None:
    one, other = Imu(), Imu()
    other.orientation_covariance[0] = 1.0
    assert one == other
    other.orientation_covariance[:] = 1.0
    assert one != other


@pytest.mark.parametrize("cls", [SetBool, Fibonacci])
def test_services_and_actions_cannot_be_instantiated(cls: type) -> None:
    with pytest.raises(NotImplementedError):
        cls()


def test_messages_pickle_and_reject_misspelt_attributes_and_hashing() -> None:
    message = Twist(linear=Vector3(x=1.0))
    assert pickle.loads(pickle.dumps(message)) == message
    with pytest.raises(AttributeError, match="'Twist' object has no attribute 'liner'"):
        message.liner = 1
    with pytest.raises(TypeError, match="unhashable type: 'Twist'"):
        hash(message)


def test_bytes_of_a_sequence_are_kept() -> None:
    assert ParameterValue(byte_array_value=[b"a"]).byte_array_value == [b"a"]


class MessageSubclass(Twist):
    """A subclass of a message class, as a program may define it."""


def test_subclass_is_sent_as_its_message_class() -> None:
    message = MessageSubclass(linear=Vector3(x=1.0))
    assert type(message._copy_()) is Twist
    assert type_name(MessageSubclass) == "geometry_msgs/msg/Twist"
    assert repr(message).endswith("MessageSubclass(linear=geometry_msgs.msg.Vector3(x=1.0, y=0.0, z=0.0), "
                                  "angular=geometry_msgs.msg.Vector3(x=0.0, y=0.0, z=0.0))")  # fmt: skip


def test_string_ends_at_a_nul() -> None:
    assert String(data="ab\0cd")._copy_().data == "ab"
    assert KeyValue(key="a\0b", value="c")._copy_() == KeyValue(key="a", value="c")
    assert JointState(name=["a\0b", "c"])._copy_().name == ["a", "c"]


def test_nonzero_defaults_come_from_the_definition() -> None:
    assert (NavSatStatus().status, NavSatStatus().service) == (-2, 0)


def test_constants_can_neither_be_set_nor_deleted() -> None:
    with pytest.raises(AttributeError, match="property 'STATUS_FIX' of 'Metaclass_NavSatStatus' object has no setter"):
        NavSatStatus.STATUS_FIX = 1
    with pytest.raises(AttributeError, match="property 'STATUS_FIX' of 'Metaclass_NavSatStatus' object has no deleter"):
        del NavSatStatus.STATUS_FIX
    assert NavSatStatus.STATUS_FIX == NavSatStatus().STATUS_FIX == 0


def test_package_lists_each_message_once_whether_it_is_loaded_or_not() -> None:
    listed = dir(std_msgs.msg)
    assert {"String", "UInt64MultiArray"} <= set(listed)
    assert len(listed) == len(set(listed))
