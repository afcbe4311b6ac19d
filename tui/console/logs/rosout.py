"""Adds the messages of `/rosout` to the log."""

from __future__ import annotations

from typing import Any

from bot_console.tui.console.launch.process_output import Add
from bot_console.tui.console.offered_qos import OfferedSubscription
from rcl_interfaces.msg import Log
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy

OURS = QoSProfile(
    history=HistoryPolicy.KEEP_ALL,
    reliability=ReliabilityPolicy.RELIABLE,
    durability=DurabilityPolicy.TRANSIENT_LOCAL,
)
"""Keeps all messages until the log has them, so that no line is lost if a node logs faster than the console reads."""
OTHERS = QoSProfile(
    depth=10_000,
    reliability=ReliabilityPolicy.RELIABLE,
    durability=DurabilityPolicy.TRANSIENT_LOCAL,
)
"""In a foreign system, the queue is limited to about 10 MB: its nodes may log faster than any link can carry."""


class RosoutWatch:
    """Adds each line to the log; in a `foreign` system it subscribes only once somebody publishes the topic."""

    def __init__(self, node: Node, log: Add, *, foreign: bool) -> None:
        self._log = log
        self.loggers: set[str] = set()
        """Names of the loggers whose lines have been received."""
        profile = OTHERS if foreign else OURS
        self._subscription = OfferedSubscription(
            node, Log, "/rosout", self._take, profile, eager=not foreign, once_weak=True
        )

    def follow(self) -> None:
        """Process a changed graph: the QoS that publishers offer may have changed."""
        self._subscription.follow()

    def _take(self, message: Log) -> None:
        stamp = message.stamp.sec * 1_000_000_000 + message.stamp.nanosec
        site = message.file, message.function, message.line
        self.loggers.add(message.name)
        self._log(stamp, _number(message.level), message.name, message.msg, site)


def _number(level: Any) -> int:
    """A severity as an integer; before Jazzy it was a byte."""
    return level[0] if isinstance(level, bytes) else int(level)
