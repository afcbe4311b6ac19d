"""A node with its own executor."""

from __future__ import annotations

import itertools
import time
from collections.abc import Callable, Iterator

import pytest
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node

_domains = itertools.count(7000)


@pytest.fixture
def node() -> Iterator[Node]:
    context = Context()
    context.init([], domain_id=next(_domains))
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
            assert time.monotonic() < deadline, "what the test waits for did not happen"
            executor.spin_once(timeout_sec=0.1)

    return until
