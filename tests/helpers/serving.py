"""A node with a separate context, served by the test."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from domains import unused_domain
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node


@contextmanager
def serving() -> Iterator[tuple[Any, SingleThreadedExecutor]]:
    """A node and the executor that serves it."""
    context = Context()
    context.init([], domain_id=unused_domain())
    executor = SingleThreadedExecutor(context=context)
    node = Node("n", context=context, enable_rosout=False, start_parameter_services=False)
    executor.add_node(node)
    yield node, executor
    node.destroy_node()
    executor.shutdown()
    context.shutdown()
