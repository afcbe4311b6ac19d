"""Spins a node while a check waits for answers."""

from __future__ import annotations

import time
from collections.abc import Callable

import rclpy
from rclpy.node import Node


def spin_for(node: Node, seconds: float, until: Callable[[], bool] = lambda: False) -> None:
    """Spin a node for `seconds`, or until `until` returns true."""
    end = time.monotonic() + seconds
    while time.monotonic() < end and not until():
        rclpy.spin_once(node, timeout_sec=0.05)
