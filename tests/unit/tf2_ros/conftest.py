"""A node with its own executor."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator

import pytest
from domains import unused_domain
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node


@pytest.fixture
def node() -> Iterator[Node]:
    context = Context()
    context.init([], domain_id=unused_domain())
    made = Node("frames", context=context)
    yield made
    made.destroy_node()
    context.try_shutdown()


@pytest.fixture
def serve(node: Node) -> Callable[[Callable[[], bool]], None]:
    """Spin the node until a condition holds."""
    executor = SingleThreadedExecutor(context=node.context)
    executor.add_node(node)

    def until(is_so: Callable[[], bool]) -> None:
        deadline = time.monotonic() + 20
        while not is_so():
            assert time.monotonic() < deadline, "the expected event did not happen"
            executor.spin_once(timeout_sec=0.1)

    return until
