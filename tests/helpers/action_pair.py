"""An action server and a client on two nodes, with the helpers that tests of both need."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from example_interfaces.action import Fibonacci
from rclpy.action import ActionClient, ActionServer


def succeed(handle: Any) -> Any:
    """Execute a goal by succeeding at once."""
    handle.succeed()
    return Fibonacci.Result(sequence=[handle.request.order])


class Pair:
    """A server of `/fib` on the node `server`, and its client on the node `client`."""

    def __init__(self, ros: Any, execute: Callable[[Any], Any] | None = succeed, **server: Any) -> None:
        self.ros = ros
        self.server_node = ros.node("server")
        self.client_node = ros.node("client")
        self.server = ActionServer(self.server_node, Fibonacci, "fib", execute, **server)
        self.client = ActionClient(self.client_node, Fibonacci, "fib")

    def outcome(self, future: Any) -> Any:
        """The result of a future, after serving the nodes until it is done."""
        self.ros.spin(future.done)
        return future.result()

    def send(self, order: int = 1, **options: Any) -> Any:
        """Send a goal; return the client's goal handle."""
        return self.outcome(self.client.send_goal_async(Fibonacci.Goal(order=order), **options))

    def result(self, handle: Any) -> Any:
        """The result response of a goal."""
        return self.outcome(handle.get_result_async())
