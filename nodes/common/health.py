"""A node's own health, published once a second on `diagnostics` in the manner of `diagnostic_updater`."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from bot_console_robot.common.demand import has_receiver
from bot_console_robot.common.diagnostics import status
from diagnostic_msgs.msg import DiagnosticArray
from rclpy.node import Node

STATUS_PERIOD_S = 1.0
"""Seconds between two statuses."""
Health = tuple[bytes, str, Mapping[str, object]]
"""Level, message and values."""


class HealthReport:
    """Publishes `<node>: <part>` with the result of `poll`, which is called every second even without subscribers."""

    def __init__(self, node: Node, part: str, poll: Callable[[], Health]) -> None:
        self._node = node
        self._name = f"{node.get_name()}: {part}"
        self._poll = poll
        self._publisher = node.create_publisher(DiagnosticArray, "diagnostics", 10)
        node.create_timer(STATUS_PERIOD_S, self._report)

    def _report(self) -> None:
        level, message, values = self._poll()
        if self.has_receiver:
            self._publisher.publish(status(self._name, level, message, values, self._node.get_clock().now().to_msg()))

    @property
    def has_receiver(self) -> bool:
        """Whether somebody receives the status."""
        return has_receiver(self._publisher)
