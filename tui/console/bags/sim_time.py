"""The time of /clock when a message was received, for a recorder whose node is not spun."""

from __future__ import annotations

import time
from bisect import bisect_right

from bot_console.tui.console.offered_qos import OfferedSubscription
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.serialization import deserialize_message
from rosgraph_msgs.msg import Clock

MAX_SAMPLES = 5000
"""The number of /clock messages remembered; earlier times are never asked for."""


class SimTime:
    """Remembers when each message of /clock was received."""

    def __init__(self, node: Node) -> None:
        self._kind = Clock
        best = QoSProfile(depth=1000, reliability=ReliabilityPolicy.RELIABLE)
        self._subscription = OfferedSubscription(node, Clock, "/clock", lambda _: None, best, raw=True)
        self._moments: list[int] = []
        self._times: list[int] = []

    def follow(self) -> None:
        """Adapt to the QoS of the present publishers."""
        self._subscription.follow()

    def update(self) -> None:
        """Take the waiting messages of /clock."""
        now = time.time_ns()
        for data, sent in self._subscription.drain():
            clock = deserialize_message(data, self._kind).clock
            self._moments.append(max(sent or now, self._moments[-1] if self._moments else 0))
            self._times.append(clock.sec * 10**9 + clock.nanosec)
        del self._moments[:-MAX_SAMPLES], self._times[:-MAX_SAMPLES]

    def at(self, moment: int) -> int | None:
        """The /clock time (ns) at a moment (ns since the epoch); None before the first message."""
        index = bisect_right(self._moments, moment)
        return self._times[index - 1] if index else None

    def destroy(self) -> None:
        """End the subscription."""
        self._subscription.destroy()
