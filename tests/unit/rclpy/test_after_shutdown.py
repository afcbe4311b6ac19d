"""What happens to programs that continue, or wait, while their context is shut down."""

from __future__ import annotations

import threading
from typing import Any

import pytest
from action_pair import Pair
from example_interfaces.action import Fibonacci
from rclpy._rclpy_pybind11 import RCLError
from rclpy.action import ActionClient
from rclpy.context import Context
from rclpy.exceptions import ROSInterruptException
from rclpy.executors import ExternalShutdownException
from std_msgs.msg import String
from std_srvs.srv import Trigger

INVALID = "rcl node's context is invalid"


def test_waiting_for_a_service_ends_with_the_context(ros: Any) -> None:
    client = ros.node().create_client(Trigger, "nobody")
    ros.context.shutdown()
    for ask in (client.service_is_ready, client.wait_for_service, lambda: client.wait_for_service(timeout_sec=1.0)):
        with pytest.raises(RCLError, match=f"failed to check service availability: {INVALID}"):
            ask()


def test_waiting_for_an_action_server_ends_with_the_context(ros: Any) -> None:
    client = ActionClient(ros.node(), Fibonacci, "nobody")
    ros.context.shutdown()
    for ask in (client.server_is_ready, client.wait_for_server, lambda: client.wait_for_server(timeout_sec=1.0)):
        with pytest.raises(RCLError, match=f"Failed to check if action server is available: {INVALID}"):
            ask()


def test_rate_sleep_raises_the_interrupt_that_shuts_down(ros: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    rate = ros.node().create_rate(1)

    class Interrupted:
        """A wait interrupted by Ctrl-C."""

        def set(self) -> None: ...
        def clear(self) -> None: ...

        def wait(self, until_ns: int) -> None:
            ros.context.shut_down_by_signal()
            raise KeyboardInterrupt

    monkeypatch.setattr(rate, "_wakeup", Interrupted())
    with pytest.raises(KeyboardInterrupt) as reported:
        rate.sleep()
    assert reported.value.__context__ is None


def test_rate_sleep_raises_after_a_shutdown_without_interrupt(ros: Any) -> None:
    rate = ros.node().create_rate(1)
    ender = threading.Timer(0, ros.context.shutdown)
    ender.start()
    with pytest.raises(ROSInterruptException):
        rate.sleep()
    ender.join()


def test_nodes_have_the_enclave_of_the_command_line(ros: Any) -> None:
    node = ros.node(args=["--enclave", "/robots/first"])
    assert node.get_node_names_and_namespaces_with_enclaves() == [("n", "/", "/robots/first")]


def test_log_configuration_file_is_refused_as_upstream_does() -> None:
    with pytest.raises(RCLError, match="failed to initialize logging: spdlog logging backend"):
        Context().init(["--ros-args", "--log-config-file", "log.conf"])


@pytest.mark.parametrize(
    ("question", "words", "problem"),
    [
        ("count_publishers", ["t"], "Error in rcl_count_publishers"),
        ("count_subscribers", ["t"], "Error in rcl_count_subscribers"),
        ("count_clients", ["t"], "Error in rcl_count_clients"),
        ("count_services", ["t"], "Error in rcl_count_services"),
        ("get_node_names", [], "Failed to get node names"),
        ("get_node_names_and_namespaces", [], "Failed to get node names"),
        ("get_node_names_and_namespaces_with_enclaves", [], "Failed to get node names"),
        ("get_fully_qualified_node_names", [], "Failed to get node names"),
        ("wait_for_node", ["n", 1.0], "Failed to get node names"),
        ("get_publishers_info_by_topic", ["t"], "Failed to get information by topic for publishers"),
        ("get_subscriptions_info_by_topic", ["t"], "Failed to get information by topic for subscriptions"),
        ("get_publisher_names_and_types_by_node", ["n", "/"], "failed to get publisher names and types"),
        ("get_service_names_and_types_by_node", ["n", "/"], "failed to get service names and types"),
    ],
)
def test_graph_queries_raise_after_shutdown(ros: Any, question: str, words: list[Any], problem: str) -> None:
    node = ros.node()
    ros.context.shutdown()
    with pytest.raises(RCLError, match=f"^{problem}: {INVALID}$"):
        getattr(node, question)(*words)


@pytest.mark.parametrize("way", ["service", "action"])
def test_unlimited_wait_for_an_answer_ends_with_the_context(
    ros: Any, way: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    node = ros.node()
    if way == "service":
        client, ask, send = node.create_client(Trigger, "nobody"), "call", "call_async"
        request: Any = Trigger.Request()
    else:
        client, ask, send = ActionClient(node, Fibonacci, "nobody"), "send_goal", "send_goal_async"
        request = Fibonacci.Goal()
    ender = threading.Timer(0, ros.context.shutdown)
    sending = getattr(client, send)

    def sent(*words: Any) -> Any:
        future = sending(*words)
        ender.start()
        return future

    monkeypatch.setattr(client, send, sent)
    with pytest.raises(ROSInterruptException):
        getattr(client, ask)(request)
    ender.join()


def test_publisher_methods_raise_after_shutdown(ros: Any) -> None:
    publisher = ros.node().create_publisher(String, "t", 1)
    ros.context.shutdown()
    with pytest.raises(
        RCLError, match=r"^Failed to assert liveliness on the Publisher: publisher's context is invalid$"
    ):
        publisher.assert_liveliness()
    with pytest.raises(RCLError, match=r"^Failed to wait for all acknowledgements: publisher's context is invalid$"):
        publisher.wait_for_all_acked()


def test_goal_executing_over_a_shutdown_ends_with_its_next_call(ros: Any) -> None:
    reported: list[str] = []

    def execute(handle: Any) -> Any:
        handle.publish_feedback(Fibonacci.Feedback())
        ros.context.shutdown()
        for show_text in (lambda: handle.publish_feedback(Fibonacci.Feedback()), handle.succeed):
            with pytest.raises(RCLError) as refused:
                show_text()
            reported.append(str(refused.value))
        return Fibonacci.Result()

    pair = Pair(ros, execute)
    pair.client.send_goal_async(Fibonacci.Goal())
    with pytest.raises(ExternalShutdownException):
        ros.spin(lambda: False)
    assert reported == [
        "Failed to publish feedback with an action server: feedback publisher is invalid",
        "Failed get goal status array: feedback publisher is invalid",
    ]


def test_waiting_for_a_first_subscription_ends_with_the_context(ros: Any) -> None:
    publisher = ros.node().create_publisher(String, "t", 1)
    assert publisher.get_subscription_count() == 0
    ros.context.shutdown()
    with pytest.raises(RCLError, match=r"^failed to get subscription count: publisher's context is invalid$"):
        publisher.get_subscription_count()
