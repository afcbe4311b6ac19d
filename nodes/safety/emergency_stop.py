"""The ROS interfaces of one node's emergency stop: requests and other nodes' states in, its own latched state out."""

from __future__ import annotations

import os
from collections.abc import Callable

from bot_console_robot.common.parameters import fixed
from bot_console_robot.safety.latch import RELEASE, STOP, Latch, Request
from bot_console_robot.safety.lock import NODE, Lock, new_id
from bot_console_robot.safety.stop_file import StopFile, StopFileError, UnreadableStopFileError
from bot_console_robot.safety.stop_messages import (
    State,
    parse_question,
    parse_request,
    parse_state,
    request_message,
    state_message,
)
from diagnostic_msgs.msg import DiagnosticStatus
from rclpy.clock import Clock
from rclpy.event_handler import QoSSubscriptionMatchedInfo, SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_srvs.srv import Trigger

REQUESTS = "emergency_stop/request"
ARBITER, BASE = "emergency_stop/arbiter", "emergency_stop/base"
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
STOP_FILE = "stop_file"
STOP_FILE_VARIABLE = "BOT_CONSOLE_STOP_FILE"
"""The environment variable with the default of the parameter `stop_file`."""
SERVICE = "service"
"""The key of stops requested by a service call, which does not identify its caller."""
WATCH_PERIOD_S = 0.1
"""Seconds between two checks whether a requester or a node has fallen silent."""
GONE_AFTER_CHECKS = 3
"""Checks without the arbiter after which the base locks; more than one, since all nodes of a system end together."""
REPORT_POLLS = 10
"""Checks between two reports of an unchanged state; a replayed report can pass for the state no longer than that."""
MAX_INSTANCES = 100
"""Maximum number of starts of the other node that are remembered."""
REFUSAL_LOG_PERIOD_S = 1.0
"""Minimum seconds between two log lines about ignored releases."""


def declare_stop_file(node: Node) -> None:
    """Declare the parameter that names the file in which a node keeps its stops."""
    default = os.environ.get(STOP_FILE_VARIABLE, "")
    node.declare_parameter(STOP_FILE, default, fixed("File that keeps stops after the node has ended; empty: none"))


class EmergencyStop:
    """A node's latch, with the services `~/stop`, `~/release` and `~/release_all`.

    `changed` is called whenever its state changes.
    """

    def __init__(
        self,
        node: Node,
        steady: Clock,
        own: str,
        other: str,
        changed: Callable[[], None],
        *,
        locked: str = "",
        stop_file: str = "",
    ) -> None:
        """`locked` is the reason to start locked; empty: start released, unless a stop is kept in `stop_file`."""
        self._node = node
        self._steady = steady
        self._changed = changed
        self._latch = Latch()
        self._instance = new_id()
        self._other = other
        self._other_instances: list[str] = []
        self._other_challenge = ""
        self._others = self._gone = self._polls = 0
        self._settled = Lock()
        self._file = StopFile(stop_file, node.get_namespace()) if stop_file else None
        self._filed: Lock | None = None
        self._unreadable = False
        self._sync_file()
        if locked:
            self._latch.stop(node.get_name(), locked)
        self._states = node.create_publisher(DiagnosticStatus, own, LATCHED)
        self._requests = node.create_publisher(DiagnosticStatus, REQUESTS, 10)
        node.create_subscription(DiagnosticStatus, REQUESTS, self._on_request, 10)
        events = SubscriptionEventCallbacks(matched=self._on_matched)
        node.create_subscription(DiagnosticStatus, other, self._on_state, LATCHED, event_callbacks=events)
        node.create_service(Trigger, "~/stop", self._on_stop)
        node.create_service(Trigger, "~/release", self._on_release)
        node.create_service(Trigger, "~/release_all", self._on_release_all)
        node.create_timer(WATCH_PERIOD_S, self._watch, clock=steady)
        self._publish()
        self._log()

    @property
    def lock(self) -> Lock:
        """Whether the robot is held, by whom and why."""
        return self._latch.lock

    @property
    def steered_by(self) -> str:
        """Who holds the steering; empty when nobody does."""
        return self._latch.steered_by

    def stop(self, holder: str, reason: str) -> None:
        """Lock for one of the node's own reasons."""
        self._settle(self._latch.stop(holder, reason))

    def _now(self) -> int:
        return self._steady.now().nanoseconds

    def _on_request(self, message: DiagnosticStatus) -> None:
        request = parse_request(message)
        if refusal := self._latch.refusal(request):
            text = f"Release by {request.holder} ignored: {refusal}"
            self._node.get_logger().warning(text, throttle_duration_sec=REFUSAL_LOG_PERIOD_S)
        changed = self._latch.request(request, self._now())
        self._settle(changed)
        question = parse_question(message)
        if question or (not changed and request.verb in (STOP, RELEASE)):
            # A requester that asks again has not received the answer, or has received a replayed state since.
            self._publish(question)

    def _on_state(self, message: DiagnosticStatus) -> None:
        state = parse_state(message)
        self._other_challenge = state.challenge
        if state.instance not in self._other_instances:
            # A message of an instance that is known already may be a replayed one, and does not mean a restart.
            restarted = bool(self._other_instances)
            self._other_instances = [*self._other_instances[-MAX_INSTANCES:], state.instance]
            if restarted and self._other == ARBITER:
                self.stop(self._node.get_name(), "the safety monitor was started again while the robot ran")
        self._settle(self._latch.follow(state.lock))

    def _on_matched(self, matched: QoSSubscriptionMatchedInfo) -> None:
        # Querying the graph would make this process follow all of it, which may be expensive.
        self._others = matched.current_count

    def _on_stop(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        request = Request(STOP, self._caller("stop"), "asked for by a service call", SERVICE, new_id())
        self._settle(self._latch.request(request, self._now()))
        self._requests.publish(request_message(request))
        response.success, response.message = self.lock.held, "locked"
        return response

    def _on_release(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        return self._release("release", [each.id for each in self.lock.stops if each.key in (SERVICE, NODE)], response)

    def _on_release_all(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        return self._release("release_all", [each.id for each in self.lock.stops], response)

    def _release(self, verb: str, ids: list[str], response: Trigger.Response) -> Trigger.Response:
        """Release stops here, and ask the robot's other locks to do the same."""
        request = Request(
            RELEASE, self._caller(verb), "", SERVICE, ids=tuple(ids), challenges=(self._other_challenge,),
            of=tuple({each.key for each in self.lock.stops if each.id in ids}),
        )  # fmt: skip
        self._settle(self._latch.release(ids, request.holder))
        self._requests.publish(request_message(request))
        response.success = not self.lock.held
        others = "; ".join(f"{each.holder}: {each.reason}" for each in self.lock.stops)
        response.message = f"still locked by {others} (release_all releases these too)" if others else "released"
        return response

    def _caller(self, verb: str) -> str:
        return f"a call of {self._node.get_name()}/{verb}"

    def _watch(self) -> None:
        self._settle(self._latch.watch(self._now()))
        self._polls += 1
        if self._polls % REPORT_POLLS == 0:
            self._restore_file()
            self._publish()
        if self._other == ARBITER and self._other_instances:
            self._gone = 0 if self._others else self._gone + 1
            if self._gone == GONE_AFTER_CHECKS:
                self.stop(self._node.get_name(), "the safety monitor has gone")

    def _settle(self, changed: bool) -> None:
        """Act on a change before publishing it, so that the published state is true.

        A stop takes effect before it is written to the file, which may take long; a release only after it is written.
        """
        if not changed:
            return
        free = not self.lock.held
        if free:
            self._sync_file()
        self._act()
        if not free and self._sync_file():
            self._act()

    def _act(self) -> None:
        self._changed()
        self._publish()
        self._log()

    def _sync_file(self) -> bool:
        """Merge the lock with the file; returns whether that has changed the lock.

        If the file cannot be used, the robot is locked, since no stop would be known after the next start. This stop is
        written as soon as the file can be used: it also stands for stops whose release could not be written.
        """
        if self._file is None or self.lock.kept == self._filed:
            return False
        try:
            both = self._file.merge(self.lock, replace_unreadable=self._unreadable and not self.lock.held)
        except StopFileError as error:
            self._unreadable = isinstance(error, UnreadableStopFileError)
            return self._latch.stop(self._node.get_name(), f"{error.effect}: {error}; {error.fix}", kept=True)
        changed = self._latch.follow(both)
        self._unreadable, self._filed = False, self.lock.kept
        return changed

    def _restore_file(self) -> None:
        """Restore the file if it was deleted or replaced, or could not be used before.

        Otherwise nobody might remember the stops after the nodes have ended.
        """
        if self._file is not None and not self._file.is_as_left:
            self._filed = None
            if self._sync_file():
                self._act()

    def _log(self) -> None:
        log, before, self._settled = self._node.get_logger(), self._settled, self.lock
        for each in self.lock.stops:
            if each.id not in before.ids:
                log.warning(f"Emergency stop: locked by {each.holder}: {each.reason}")
        if before.held and not self.lock.held:
            by = next((each.by for each in reversed(self.lock.released) if each.id in before.ids), "")
            log.info(f"Emergency stop: released by {by}")

    def _publish(self, question: str = "") -> None:
        state = State(self.lock, self._instance, self._latch.challenge, self.steered_by, question)
        self._states.publish(state_message(state, self._node.get_name()))
