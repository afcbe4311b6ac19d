"""The services and topics of an action on the wire and in the graph."""

from __future__ import annotations

from typing import Any

import pytest
from action_pair import Pair, succeed
from example_interfaces.action import Fibonacci
from rclpy._rclpy_pybind11 import RCLError
from rclpy.action import (
    ActionClient,
    ActionServer,
    get_action_client_names_and_types_by_node,
    get_action_names_and_types,
    get_action_server_names_and_types_by_node,
)

FIBONACCI = ["example_interfaces/action/Fibonacci"]


def test_action_has_its_services_and_topics_on_the_wire(ros: Any) -> None:
    pair = Pair(ros)
    services = dict(pair.client_node.get_service_names_and_types_by_node("server", "/"))
    topics = dict(pair.client_node.get_publisher_names_and_types_by_node("server", "/"))
    assert {name: types for name, types in {**services, **topics}.items() if "/_action/" in name} == {
        "/fib/_action/send_goal": ["example_interfaces/action/Fibonacci_SendGoal"],
        "/fib/_action/cancel_goal": ["action_msgs/srv/CancelGoal"],
        "/fib/_action/get_result": ["example_interfaces/action/Fibonacci_GetResult"],
        "/fib/_action/feedback": ["example_interfaces/action/Fibonacci_FeedbackMessage"],
        "/fib/_action/status": ["action_msgs/msg/GoalStatusArray"],
    }


def test_topics_have_upstreams_qos(ros: Any) -> None:
    pair = Pair(ros)
    (status,) = pair.client_node.get_publishers_info_by_topic("/fib/_action/status")
    (feedback,) = pair.client_node.get_publishers_info_by_topic("/fib/_action/feedback")
    assert (status.qos_profile.durability.name, status.qos_profile.depth) == ("TRANSIENT_LOCAL", 1)
    assert (feedback.qos_profile.durability.name, feedback.qos_profile.depth) == ("VOLATILE", 10)


def test_graph_queries_list_actions(ros: Any) -> None:
    pair = Pair(ros)
    node = pair.client_node
    assert get_action_names_and_types(node) == [("/fib", FIBONACCI)]
    assert get_action_server_names_and_types_by_node(node, "server", "/") == [("/fib", FIBONACCI)]
    assert get_action_client_names_and_types_by_node(node, "server", "/") == []
    assert get_action_client_names_and_types_by_node(node, "client", "/") == [("/fib", FIBONACCI)]
    with pytest.raises(RCLError, match="for nonexistent node"):
        get_action_server_names_and_types_by_node(node, "nobody", "/")


@pytest.mark.parametrize(
    ("name", "full"), [("fib", "/ns/fib"), ("/fib", "/fib"), ("~/fib", "/ns/n/fib"), ("a/b", "/ns/a/b")]
)
def test_names_are_expanded(ros: Any, name: str, full: str) -> None:
    node = ros.node(namespace="ns")
    ActionServer(node, Fibonacci, name, succeed)
    assert get_action_names_and_types(node) == [(full, FIBONACCI)]


def test_services_and_topics_are_remapped_individually(ros: Any) -> None:
    ros.init("-r", "fib:=other", "-r", "fib/_action/send_goal:=elsewhere")
    node = ros.node()
    ActionServer(node, Fibonacci, "fib", succeed)
    services = dict(node.get_service_names_and_types())
    assert "/elsewhere" in services
    assert "/fib/_action/get_result" in services


@pytest.mark.parametrize(
    ("name", "why"),
    [
        ("a b", "topic name must not contain characters other than alphanumerics, '_', '~', '{', or '}'"),
        ("1st", "topic name token must not start with a number"),
        ("a/", "topic name must not contain repeated '/'"),
        ("{x}", "unknown substitution: {x}"),
    ],
)
def test_invalid_names_are_rejected_with_upstreams_reasons(ros: Any, name: str, why: str) -> None:
    node = ros.node()
    with pytest.raises(ValueError, match="Failed") as error:
        ActionServer(node, Fibonacci, name, succeed)
    assert str(error.value) == f"Failed to create action server due to invalid topic name '{name}' : : {why}"
    with pytest.raises(ValueError, match="Failed") as error:
        ActionClient(node, Fibonacci, name)
    assert str(error.value) == f"Failed to create action client due to invalid topic name '{name}' : {why}"
    assert get_action_names_and_types(node) == []


def test_empty_names_are_rejected(ros: Any) -> None:
    node = ros.node()
    with pytest.raises(ValueError, match=r"server due to invalid topic name '' : : invalid empty action name$"):
        ActionServer(node, Fibonacci, "", succeed)
    with pytest.raises(ValueError, match=r"client: failed to get goal service name$"):
        ActionClient(node, Fibonacci, "")
    assert get_action_names_and_types(node) == []


def test_negative_result_timeout_is_rejected(ros: Any) -> None:
    node = ros.node()
    with pytest.raises(ValueError, match="Failed to create action server: timer period must be non-negative"):
        ActionServer(node, Fibonacci, "fib", succeed, result_timeout=-1)
    assert get_action_names_and_types(node) == []


def test_server_is_ready_only_with_all_its_parts(ros: Any) -> None:
    pair = Pair(ros)
    assert pair.client.server_is_ready()
    pair.server_node._ros_bus.remove(pair.server._endpoints.status)
    assert not pair.client.server_is_ready()


def test_waitables_count_their_entities(ros: Any) -> None:
    pair = Pair(ros)
    assert vars(pair.server.get_num_entities()) == {
        "num_subscriptions": 0,
        "num_guard_conditions": 0,
        "num_timers": 1,
        "num_clients": 0,
        "num_services": 3,
        "num_events": 0,
    }
    assert pair.client.get_num_entities().num_subscriptions == 2
    assert list(pair.server_node.waitables) == [pair.server]
