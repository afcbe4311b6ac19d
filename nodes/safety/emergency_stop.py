"""The emergency stop of one node, as ROS interfaces: requests and other nodes' states in, its own latched state out."""

from __future__ import annotations

from collections.abc import Callable

from bot_console_robot.safety.latch import RELEASE, STOP, Latch, Lock, Request
from bot_console_robot.safety.stop_messages import lock_of, request_message, request_of, state_message
from diagnostic_msgs.msg import DiagnosticStatus
from rclpy.clock import Clock
from rclpy.event_handler import QoSSubscriptionMatchedInfo, SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_srvs.srv import Trigger

REQUESTS = "emergency_stop/request"
ARBITER, BASE = "emergency_stop/arbiter", "emergency_stop/base"
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
SERVICE = "service"
"""The key of stops that were asked for by a service call, which does not tell who calls."""
WATCH_PERIOD = 0.1
"""Seconds between two looks at who has fallen silent."""
GONE = 3
"""Looks in which the arbiter is not there before the base locks; all end together when a system ends."""


class EmergencyStop:
    """A node's latch, with the services `~/stop`, `~/release` and `~/release_all`.

    `changed` is called whenever its state changes.
    """

    def __init__(
        self, node: Node, steady: Clock, own: str, other: str, changed: Callable[[], None], lock: Lock | None = None
    ) -> None:
        self._node = node
        self._steady = steady
        self._changed = changed
        self._latch = Latch(lock)
        self._instance = str(steady.now().nanoseconds)
        self._other = other
        self._other_instance = ""
        self._others = self._gone = 0
        self._told = self._latch.lock.stops
        self._states = node.create_publisher(DiagnosticStatus, own, LATCHED)
        self._requests = node.create_publisher(DiagnosticStatus, REQUESTS, 10)
        node.create_subscription(DiagnosticStatus, REQUESTS, self._on_request, 10)
        events = SubscriptionEventCallbacks(matched=self._on_matched)
        node.create_subscription(DiagnosticStatus, other, self._on_state, LATCHED, event_callbacks=events)
        node.create_service(Trigger, "~/stop", self._on_stop)
        node.create_service(Trigger, "~/release", self._on_release)
        node.create_service(Trigger, "~/release_all", self._on_release_all)
        node.create_timer(WATCH_PERIOD, self._watch, clock=steady)
        self._publish()

    @property
    def lock(self) -> Lock:
        """Whether the robot is held, by whom and why."""
        return self._latch.lock

    @property
    def steered_by(self) -> str:
        """Who holds the steering; empty when nobody does."""
        return self._latch.steered_by

    def stop(self, holder: str, reason: str) -> None:
        """Lock."""
        self._note(self._latch.stop(holder, reason))

    def _now(self) -> int:
        return self._steady.now().nanoseconds

    def _on_request(self, message: DiagnosticStatus) -> None:
        self._note(self._latch.request(request_of(message), self._now()))

    def _on_state(self, message: DiagnosticStatus) -> None:
        lock, instance = lock_of(message)
        restarted = self._other_instance not in ("", instance)
        self._other_instance = instance
        if restarted and self._other == ARBITER:
            self.stop(self._node.get_name(), "the safety monitor was started again while the robot ran")
        self._note(self._latch.follow(lock))

    def _on_matched(self, matched: QoSSubscriptionMatchedInfo) -> None:
        # To ask the graph for it would make this process follow all of the graph, in which there may be much going on.
        self._others = matched.current_count

    def _on_stop(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        response.message = "locked"
        return self._asked(Request(STOP, self._caller("stop"), "asked for by a service call", SERVICE), response)

    def _on_release(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        return self._asked(Request(RELEASE, self._caller("release"), "", SERVICE), response)

    def _on_release_all(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        held = tuple(each.key for each in self.lock.stops)
        return self._asked(Request(RELEASE, self._caller("release_all"), "", SERVICE, held), response)

    def _caller(self, verb: str) -> str:
        return f"a call of {self._node.get_name()}/{verb}"

    def _asked(self, request: Request, response: Trigger.Response) -> Trigger.Response:
        """Carry out a request, and forward it to the robot's other latches."""
        self._note(self._latch.request(request, self._now()))
        self._requests.publish(request_message(request))
        response.success = self.lock.held is (request.verb == STOP)
        if request.verb == RELEASE:
            others = "; ".join(f"{each.holder}: {each.reason}" for each in self.lock.stops)
            response.message = f"still locked by {others} (release_all releases these too)" if others else "released"
        return response

    def _watch(self) -> None:
        self._note(self._latch.watch(self._now()))
        if self._other == ARBITER and self._other_instance:
            self._gone = 0 if self._others else self._gone + 1
            if self._gone == GONE:
                self.stop(self._node.get_name(), "the safety monitor has gone")

    def _note(self, changed: bool) -> None:
        """Act on a change before it is published, so that what is published is true."""
        if changed:
            self._changed()
            self._publish()
        self._tell()

    def _tell(self) -> None:
        log, told, self._told = self._node.get_logger(), self._told, self.lock.stops
        for each in self.lock.stops:
            if each.key not in {other.key for other in told}:
                log.warning(f"Emergency stop: locked by {each.holder}: {each.reason}")
        if told and not self.lock.held:
            log.info("Emergency stop: released")

    def _publish(self) -> None:
        self._states.publish(state_message(self.lock, self._node.get_name(), self._instance, self.steered_by))
