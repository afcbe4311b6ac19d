"""`~/get_type_description`: its answers, and how it is switched off."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
import rclpy
from bot_console.runtime.rosidl.type_hash import text
from example_interfaces.action import Fibonacci
from geometry_msgs.msg import Twist
from rclpy.action import ActionServer
from rclpy.executors import SingleThreadedExecutor
from std_srvs.srv import Trigger
from type_description_interfaces.srv import GetTypeDescription


@pytest.fixture
def node() -> Iterator[Any]:
    context = rclpy.Context()
    rclpy.init(args=[], context=context)
    made = rclpy.create_node("n", namespace="/ns", context=context)
    yield made
    made.destroy_node()
    rclpy.try_shutdown(context=context)


def ask(node: Any, **request: Any) -> Any:
    client = node.create_client(GetTypeDescription, "/ns/n/get_type_description")
    executor = SingleThreadedExecutor(context=node.context)
    executor.add_node(node)
    future = client.call_async(GetTypeDescription.Request(**request))
    executor.spin_until_future_complete(future, timeout_sec=10.0)
    executor.remove_node(node)
    return future.result()


def test_type_of_the_node_is_described(node: Any) -> None:
    node.create_publisher(Twist, "cmd_vel", 1)
    answer = ask(node, type_name="geometry_msgs/msg/Twist", type_hash=text(Twist), include_type_sources=True)
    assert (answer.successful, answer.failure_reason) == (True, "")
    top = answer.type_description.type_description
    assert top.type_name == "geometry_msgs/msg/Twist"
    assert [(each.name, each.type.type_id, each.type.nested_type_name) for each in top.fields] == [
        ("linear", 1, "geometry_msgs/msg/Vector3"),
        ("angular", 1, "geometry_msgs/msg/Vector3"),
    ]
    assert [each.type_name for each in answer.type_description.referenced_type_descriptions] == [
        "geometry_msgs/msg/Vector3"
    ]
    assert [(each.type_name, each.encoding) for each in answer.type_sources] == [
        ("geometry_msgs/msg/Twist", "msg"),
        ("geometry_msgs/msg/Vector3", "msg"),
    ]
    assert "linear" in answer.type_sources[0].raw_file_contents


def test_service_of_the_node_is_described(node: Any) -> None:
    node.create_service(Trigger, "go", lambda request, response: response)
    answer = ask(node, type_hash=text(Trigger), include_type_sources=False)
    assert answer.type_description.type_description.type_name == "std_srvs/srv/Trigger"
    assert len(answer.type_sources) == 0


def test_action_of_the_node_and_its_parts_are_described(node: Any) -> None:
    server = ActionServer(node, Fibonacci, "fib", lambda goal: Fibonacci.Result())
    name = "example_interfaces/action/Fibonacci"
    answer = ask(node, type_hash=text(Fibonacci), include_type_sources=True)
    assert answer.type_description.type_description.type_name == name
    sources = {each.type_name: (each.encoding, each.raw_file_contents) for each in answer.type_sources}
    assert sources[name][0] == "action" and "int32 order" in sources[name][1]
    assert sources[f"{name}_Goal"] == ("implicit", "")
    impl = Fibonacci.Impl
    for each, part in (
        (impl.SendGoalService, "SendGoal"),
        (impl.GetResultService, "GetResult"),
        (impl.FeedbackMessage, "FeedbackMessage"),
    ):
        found = ask(node, type_hash=text(each), include_type_sources=False).type_description
        assert found.type_description.type_name == f"{name}_{part}"
    server.destroy()
    assert not ask(node, type_hash=text(Fibonacci)).successful


def test_unknown_type_is_reported(node: Any) -> None:
    assert ask(node, type_hash=text(Twist)).failure_reason == "Type not currently in use by this node"
    assert ask(node, type_hash="RIHS01_12").failure_reason == "Failed to parse type hash"


def test_parameter_switches_the_service_off() -> None:
    context = rclpy.Context()
    rclpy.init(args=["--ros-args", "-p", "start_type_description_service:=false"], context=context)
    node = rclpy.create_node("without", context=context)
    names = [name for name, _ in node.get_service_names_and_types_by_node("without", "/")]
    assert "/without/get_parameters" in names
    assert "/without/get_type_description" not in names
    assert node.describe_parameter("start_type_description_service").read_only
    node.destroy_node()
    rclpy.try_shutdown(context=context)
