"""The clock by which a robot's messages age: a simulation that lags behind real time is slow, not broken."""

from __future__ import annotations

from rclpy.clock import Clock
from rclpy.event_handler import QoSSubscriptionMatchedInfo, SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rosgraph_msgs.msg import Clock as ClockMessage

TOPIC = "/clock"
FAR_NS = 5_000_000_000
"""A clock that differs from a scan's stamp by more than these nanoseconds is not the robot's."""
NEWEST = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)


class RobotTime:
    """Steady time until a message is late while a simulator publishes its time; from then on, the simulator's time.

    It costs nothing until then, and never goes backwards, even if a simulation restarts or its clock stops.
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
        """Switch to simulated time, if there is a simulation and the robot's messages are stamped with its time.

        `stamp` (ns) is that of the newest scan. A clock far from it, such as that of a bag being played, is not the
        robot's.
        """
        self._stamp = stamp
        if self._subscription is None:
            events = SubscriptionEventCallbacks(matched=self._on_matched)
            self._subscription = self._node.create_subscription(
                ClockMessage, TOPIC, self._on_clock, NEWEST, event_callbacks=events
            )

    def _on_matched(self, matched: QoSSubscriptionMatchedInfo) -> None:
        # Querying the graph for clocks would make this process track the whole graph, while the machine is too busy
        # already.
        if matched.current_count == 0:
            self._leave()

    def note_stamp(self, stamp: int) -> None:
        """Record the stamp (ns) of a scan for comparison with a clock."""
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
