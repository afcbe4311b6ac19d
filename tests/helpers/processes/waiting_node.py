"""A node that waits to be stopped, for tests of launches: it prints `up`, and `interrupted` when it receives SIGINT."""

from __future__ import annotations

from typing import Any

from launch.actions import RegisterEventHandler
from launch.event_handlers import OnProcessIO

WAITS = """
import rclpy
from rclpy.node import Node
rclpy.init()
node = Node("x")

def up():
    timer.cancel()
    print("up")

timer = node.create_timer(0.001, up)
try:
    rclpy.spin(node)
except KeyboardInterrupt:
    print("interrupted")
"""
"""The text of its program."""


def once_up(node: Any, then: Any) -> RegisterEventHandler:
    """Execute launch entities, or a function that returns some, when that node has printed `up`."""
    return RegisterEventHandler(
        OnProcessIO(target_action=node, on_stdout=lambda event: then if b"up" in event.text else None)
    )
