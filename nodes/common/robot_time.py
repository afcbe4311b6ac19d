"""The clock by which to judge a robot that may be simulated: one that lags behind real time is slow, not broken."""

from __future__ import annotations

from rclpy.clock import Clock
from rclpy.event_handler import QoSSubscriptionMatchedInfo, SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rosgraph_msgs.msg import Clock as ClockMessage

TOPIC = "/clock"
FAR_NS = 5_000_000_000
"""A clock so far from a scan's stamp is another one's."""
NEWEST = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)


class RobotTime:
    """Steady time, until a message is late and a simulator publishes the time of its world; that time from then on.

    It costs nothing before it is asked for, and never goes back, even when a simulation restarts or its clock ends.
    """

    def __init__(self, node: Node, steady: Clock) -> None:
        self._node = node
        self._steady = steady
        self._subscription: object = None
        self._anchor = 0
        self._origin: int | None = None
        self._simulated = 0
        self._stamp = 0

    def now(self) -> int:
        """Nanoseconds since an arbitrary moment."""
        if self._origin is None:
            return self._anchor + self._steady.now().nanoseconds
        return self._anchor + self._simulated - self._origin

    def follow(self, stamp: int) -> None:
        """Go by the simulation's time from now on, if there is a simulation and what the robot sends is stamped in it.

        `stamp` (ns) is that of the newest scan: a clock far from it, as of a bag that is played, is not the robot's.
        """
        self._stamp = stamp
        if self._subscription is None:
            events = SubscriptionEventCallbacks(matched=self._on_matched)
            self._subscription = self._node.create_subscription(
                ClockMessage, TOPIC, self._on_clock, NEWEST, event_callbacks=events
            )

    def _on_matched(self, matched: QoSSubscriptionMatchedInfo) -> None:
        # To ask the graph for clocks would make this process follow all of it, when the machine is too busy already.
        if matched.current_count == 0:
            self._leave()

    def heard(self, stamp: int) -> None:
        """Take note of the stamp (ns) of a scan, to compare a clock with."""
        self._stamp = stamp

    def _leave(self) -> None:
        if self._origin is not None:
            self._anchor, self._origin = self.now() - self._steady.now().nanoseconds, None

    def _on_clock(self, message: ClockMessage) -> None:
        simulated = message.clock.sec * 1_000_000_000 + message.clock.nanosec
        if abs(simulated - self._stamp) > FAR_NS:
            self._leave()
        elif self._origin is None or simulated < self._simulated:
            self._anchor, self._origin = self.now(), simulated
        self._simulated = simulated
