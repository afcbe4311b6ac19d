"""A separate context for each test, with the nodes and executors that the test creates in it."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from typing import Any

import pytest
from bot_console.runtime.process.stepping.stepped_time import stepped
from domains import unused_domain
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node

LONG = 240.0
"""How long (s) a test waits for an expected event before it fails."""


class Ros:
    """Nodes of one domain, served by the test."""

    def __init__(self) -> None:
        self.domain = unused_domain()
        self.context: Any = None
        self._executor: Any = None

    def init(self, *words: str) -> Context:
        """Initialize the context with the arguments after `--ros-args`."""
        self.context = Context()
        self.context.init(["test", "--ros-args", *words], domain_id=self.domain)
        self._executor = SingleThreadedExecutor(context=self.context)
        return self.context

    def node(self, name: str = "n", args: Sequence[str] = (), **options: Any) -> Node:
        """Create a node served by `spin`; `args` apply only if the context is not initialized yet."""
        if self.context is None:
            self.init(*args)
        node = Node(name, context=self.context, **options)
        self._executor.add_node(node)
        return node

    def spin(self, until: Callable[[], bool]) -> None:
        """Spin all nodes until a condition holds."""
        deadline = time.monotonic() + LONG
        while not until():
            assert time.monotonic() < deadline, "the expected event did not happen"
            self._executor.spin_once(timeout_sec=LONG)

    def settle(self) -> None:
        """Run all callbacks that are ready now."""
        for _ in range(50):
            self._executor.spin_once(timeout_sec=0)

    def ask(self, node: Node, service: Any, name: str, **fields: Any) -> Any:
        """Call a service and return its response."""
        client = node.create_client(service, name)
        future = client.call_async(service.Request(**fields))
        self.spin(future.done)
        return future.result()

    def end(self) -> None:
        """Destroy everything."""
        if self.context is None:
            return
        for node in self._executor.get_nodes():
            node.destroy_node()
        self._executor.shutdown()
        self.context.try_shutdown()


@pytest.fixture
def ros() -> Iterator[Ros]:
    """Nodes and their context."""
    made = Ros()
    yield made
    made.end()


@pytest.fixture
def stepped_ros() -> Iterator[Ros]:
    """Nodes in stepped time: waiting lets time jump to the next event."""
    with stepped(stall_s=30.0):
        made = Ros()
        yield made
        made.end()
