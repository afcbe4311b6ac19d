"""Which classes count as message, service or action types, and the errors for others."""

from __future__ import annotations

from typing import Any

import pytest
from example_interfaces.action import Fibonacci
from rclpy._rclpy_pybind11 import RMWError
from rclpy.serialization import deserialize_message, serialize_message
from rclpy.type_hash import TypeHash, type_hash_of
from rclpy.type_support import check_is_valid_action_type, check_is_valid_msg_type, check_is_valid_srv_type
from std_msgs.msg import String
from std_srvs.srv import Trigger

ROS1 = "This might be a ROS 1 message type but it should be a ROS 2 message type."


def test_valid_types_are_accepted() -> None:
    check_is_valid_msg_type(String)
    check_is_valid_msg_type(Trigger.Request)
    check_is_valid_srv_type(Trigger)
    check_is_valid_srv_type(Fibonacci.Impl.SendGoalService)
    check_is_valid_action_type(Fibonacci)


@pytest.mark.parametrize(
    ("check", "cls", "kind", "others"),
    [
        (check_is_valid_msg_type, Trigger, "message", "service or action"),
        (check_is_valid_msg_type, Fibonacci, "message", "service or action"),
        (check_is_valid_srv_type, String, "service", "message or action"),
        (check_is_valid_srv_type, Fibonacci, "service", "message or action"),
        (check_is_valid_action_type, String, "action", "message or service"),
    ],
)
def test_interface_of_another_kind_is_rejected(check: Any, cls: Any, kind: str, others: str) -> None:
    with pytest.raises(RuntimeError) as caught:
        check(cls)
    assert str(caught.value) == f"The {kind} type provided is not valid ({cls}), this might be a {others}"


@pytest.mark.parametrize("thing", [int, "std_msgs/msg/String", None, String()])
@pytest.mark.parametrize("check", [check_is_valid_msg_type, check_is_valid_srv_type])
def test_class_that_is_not_an_interface_is_rejected(check: Any, thing: Any) -> None:
    with pytest.raises(AttributeError, match=ROS1):
        check(thing)


def test_messages_are_serialized_and_deserialized() -> None:
    data = serialize_message(String(data="hi"))
    assert data == bytes.fromhex("0001 0000 0300 0000 6869 00")
    assert deserialize_message(data, String) == String(data="hi")
    with pytest.raises(RMWError, match="failed to deserialize ROS message: no CDR header"):
        deserialize_message(b"", String)
    with pytest.raises(AttributeError, match=ROS1):
        serialize_message("hi")


def test_type_hash_is_upstreams() -> None:
    found = type_hash_of(String)
    assert str(found) == "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18"
    assert found == TypeHash(1, found.value) != TypeHash()
    assert str(TypeHash()) == "INVALID"
    with pytest.raises(AssertionError):
        TypeHash(value="x")  # type: ignore[arg-type]
