"""Interface classes by name, and lists of interfaces."""

from __future__ import annotations

import pytest
import rosidl_runtime_py as runtime
from example_interfaces.action import Fibonacci
from rosidl_parser.definition import NamespacedType
from rosidl_runtime_py.utilities import get_action, get_interface, get_message, get_service
from std_msgs.msg import String
from std_srvs.srv import Trigger


def test_classes_are_found_by_name() -> None:
    assert get_message("std_msgs/msg/String") is get_message("std_msgs/String") is get_interface("std_msgs/msg/String")
    assert get_service("std_srvs/srv/Trigger") is get_service("std_srvs/Trigger") is Trigger
    assert get_action("example_interfaces/action/Fibonacci") is Fibonacci


@pytest.mark.parametrize(
    ("get", "name", "words"),
    [
        (get_message, "std_srvs/srv/Trigger", "Expected the full name of a message, got 'std_srvs/srv/Trigger'"),
        (get_service, "std_msgs/msg/String", "Expected the full name of a service, got 'std_msgs/msg/String'"),
        (get_action, "std_msgs/msg/String", "Expected the full name of an action, got 'std_msgs/msg/String'"),
    ],
)
def test_interface_of_the_wrong_kind_is_rejected(get: object, name: str, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        get(name)  # type: ignore[operator]


def test_missing_interfaces_raise_import_errors() -> None:
    with pytest.raises(AttributeError, match=r"module 'std_msgs\.msg' has no attribute 'Nope'"):
        get_message("std_msgs/msg/Nope")
    with pytest.raises(ModuleNotFoundError, match="No module named 'nope_msgs'"):
        get_message("nope_msgs/msg/X")


def test_namespaced_types_are_imported() -> None:
    get = runtime.import_message_from_namespaced_type
    assert get(NamespacedType(["std_msgs", "msg"], "String")) is String
    feedback = NamespacedType(["example_interfaces", "action"], "Fibonacci_FeedbackMessage")
    assert get(feedback) is Fibonacci.Impl.FeedbackMessage


def test_interfaces_are_listed_by_package() -> None:
    assert runtime.get_service_interfaces(["std_srvs"]) == {"std_srvs": ["srv/Empty", "srv/SetBool", "srv/Trigger"]}
    assert runtime.get_message_interfaces(["std_srvs"]) == {}
    assert "action/Fibonacci" in runtime.get_action_interfaces()["example_interfaces"]
    assert {"msg/String", "msg/Int32"} < set(runtime.get_interfaces(["std_msgs"])["std_msgs"])
    assert "geometry_msgs" in runtime.get_interface_packages()
    with pytest.raises(LookupError, match="Unknown package 'nope_msgs'"):
        runtime.get_interfaces(["nope_msgs"])


def test_interface_path_is_in_the_share_folder() -> None:
    path = runtime.get_interface_path("std_msgs/msg/String")
    assert path == runtime.get_interface_path("std_msgs/msg/String.msg")
    assert path.endswith("share/std_msgs/msg/String.msg")


@pytest.mark.parametrize(
    ("name", "error", "words"),
    [
        ("String", ValueError, "Invalid name 'String'. Expected at least two parts separated by '/'"),
        ("std_msgs//String", ValueError, "Invalid name 'std_msgs//String'. Must not contain empty parts"),
        ("std_msgs/../x", ValueError, "Invalid name 'std_msgs/../x'. Must not contain '..'"),
        ("nope_msgs/msg/X", LookupError, "Unknown package 'nope_msgs'"),
        ("std_msgs/msg/Nope", LookupError, "share/std_msgs/msg/Nope.idl'"),
    ],
)
def test_invalid_interface_paths_are_rejected(name: str, error: type[Exception], words: str) -> None:
    with pytest.raises(error) as caught:
        runtime.get_interface_path(name)
    assert str(caught.value).endswith(words)
