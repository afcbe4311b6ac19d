"""Runs a demo node."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Generator

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node


@contextlib.contextmanager
def initialised(args: list[str] | None) -> Generator[None]:
    """Initialise rclpy for a `with` block, which an interrupt or the shutdown of the context ends without an error."""
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException):
        rclpy.init(args=args)
        try:
            yield
        finally:
            rclpy.try_shutdown()


def run(make_node: Callable[[], Node], args: list[str] | None, cycles: int | None = None) -> None:
    """Spin a node until it is interrupted, its context is shut down, or a number of callbacks have run."""
    with initialised(args):
        node = make_node()
        if cycles is None:
            rclpy.spin(node)
        for _ in range(cycles or 0):
            rclpy.spin_once(node)
