"""A service that adds two numbers, and clients that call it once."""

from __future__ import annotations

from functools import partial

import rclpy
from bot_console_demos.running import initialised, run
from example_interfaces.srv import AddTwoInts
from rclpy.node import Node


class Server(Node):
    """Serves `add_two_ints`."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.create_service(AddTwoInts, "add_two_ints", self._add)

    def _add(self, request: AddTwoInts.Request, response: AddTwoInts.Response) -> AddTwoInts.Response:
        response.sum = request.a + request.b
        self.get_logger().info(f"Incoming request\na: {request.a} b: {request.b}")
        return response


def _ask(name: str, a: int, b: int, prefix: str, args: list[str] | None) -> None:
    """Wait for the server, call it, log the sum behind `prefix`, and exit."""
    with initialised(args):
        node = rclpy.create_node(name)
        client = node.create_client(AddTwoInts, "add_two_ints")
        while not client.wait_for_service(timeout_sec=1.0):
            node.get_logger().info("service not available, waiting again...")
        answer = client.call_async(AddTwoInts.Request(a=a, b=b))
        rclpy.spin_until_future_complete(node, answer)
        response = answer.result()
        if response is None:
            node.get_logger().error(f"service call failed: {answer.exception()}")
        else:
            node.get_logger().info(f"Result of add_two_ints: {prefix}{response.sum}")


def serve(args: list[str] | None = None) -> None:
    """Entry point of the server in both demo packages."""
    run(partial(Server, "add_two_ints_server"), args)


def ask(args: list[str] | None = None) -> None:
    """Entry point of the clients in both demo packages."""
    _ask("add_two_ints_client", 2, 3, "", args)


def serve_minimal(args: list[str] | None = None) -> None:
    """Entry point of both services of `examples_rclpy_minimal_service`."""
    run(partial(Server, "minimal_service"), args)


def ask_minimal(args: list[str] | None = None) -> None:
    """Entry point of every client of `examples_rclpy_minimal_client`."""
    _ask("minimal_client", 41, 1, "for 41 + 1 = ", args)
