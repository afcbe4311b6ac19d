"""The robot's emergency stop as the console requests and sees it: requests, and what every lock has acknowledged.

The interface is that of `docs/safety.md`; a robot without it is stopped by zero velocities, which nobody acknowledges.
"""

from __future__ import annotations

import getpass
import json
import os
import platform
import threading
import time
import uuid
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

from bot_console.tui.console.robot.robot_model import RobotStop
from bot_console.tui.text.encodable import encodable
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile

STATUS = "diagnostic_msgs/msg/DiagnosticStatus"
FOLDER, REQUEST = "/emergency_stop/", "request"
STOP, RELEASE, STEER, HAND_BACK = "stop", "release", "steer", "hand_back"
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
NODE = "node"
"""The key of stops that a node of the robot made."""
HEARTBEAT = 0.2
"""Seconds between two words of a console that holds the steering; after 1 s of silence the robot locks itself."""
PATIENCE = 2.0
"""Seconds for which a release is said again while a lock has not heard it."""


@dataclass(frozen=True, slots=True)
class StopInfo:
    """What is known about the stop: requested or seen, acknowledged by every lock, by whom and why."""

    stopped: bool = False
    confirmed: bool = False
    holder: str = ""
    reason: str = ""
    steered_by: str = ""
    locks: int = 0
    here: bool = False
    """Whether one of the stops is our own."""
    stops: tuple[RobotStop, ...] = ()
    """Everybody's stops, the oldest first."""


class StopLink:
    """Sends requests to all locks of the robots on the graph, repeatedly until they acknowledge.

    `stop`, `release`, `steer` and `hand_back` may be called from any thread and send at once.
    """

    def __init__(self, node: Node, holder: str = "", key: str = "") -> None:
        """`key` distinguishes this requester's stops from others'; a new one each time unless given."""
        self._node = node
        self.holder = encodable(holder) or f"bot-console of {user()} (pid {os.getpid()})"
        self._key = encodable(key) or uuid.uuid4().hex
        self._watching: dict[str, Any] = {}
        self._states: dict[str, dict[str, str]] = {}
        self._requests: dict[str, Any] = {}
        self._wanted = ""
        self._reason = ""
        self._of: tuple[str, ...] = ()
        self._since = 0.0
        self._steered = 0.0
        self.steering = False
        """Whether this console holds the steering."""
        self._telling = threading.Condition()
        self.info = StopInfo()

    def follow(self, topics: Iterable[str]) -> None:
        """Watch the locks among these topics of type `DiagnosticStatus`."""
        found = {each for each in topics if FOLDER in each and not each.endswith(FOLDER + REQUEST)}
        for gone in set(self._watching) - found:
            self._node.destroy_subscription(self._watching.pop(gone))
            self._states.pop(gone, None)
        for topic in found - set(self._watching):
            asked = topic.rpartition("/")[0] + "/" + REQUEST
            if asked not in self._requests:
                self._requests[asked] = self._node.create_publisher(DiagnosticStatus, asked, 10)
            self._watching[topic] = self._node.create_subscription(
                DiagnosticStatus, topic, partial(self._saw, topic), LATCHED
            )
        self._update()

    def _saw(self, topic: str, message: DiagnosticStatus) -> None:
        self._states[topic] = {each.key: each.value for each in message.values}
        self._update()

    def _update(self) -> None:
        with self._telling:  # else what was known before could be told after what is known since
            self._tell()
            self._telling.notify_all()

    def await_held(self, patience: float) -> bool:
        """Wait, at most so many seconds, until every lock has acknowledged the request and holds; whether so."""
        with self._telling:
            return self._telling.wait_for(lambda: self.info.confirmed, patience)

    def _tell(self) -> None:
        states = [self._states.get(each, {}) for each in list(self._watching)]
        held = [each for each in states if each.get("locked") == "true"]
        confirmed = bool(states) and len(held) == len(states)
        stops = [_stops(each, self._key) for each in held]
        known_all = bool(states) and all("locked" in each for each in states)
        # A stop without a key is all that a lock tells of those that hold it: it counts as ours and as what we release.
        heard = all(any(each.here or not each.key for each in known) for known in stops)
        left = any(each.key in self._of or not each.key for known in stops for each in known)
        if (self._wanted == STOP and confirmed and heard) or (self._wanted == RELEASE and known_all and not left):
            self._wanted = ""
        known = tuple({each.key: each for of_lock in stops for each in of_lock}.values())
        ours = self._wanted == STOP
        reason = self._reason if ours else ""
        if known:
            reason = known[0].reason
        self.info = StopInfo(
            stopped=bool(held) or ours,
            confirmed=confirmed and not ours,
            holder=known[0].holder if known else "",
            reason=reason,
            steered_by=next((each["steered_by"] for each in states if each.get("steered_by")), ""),
            locks=len(states),
            here=ours or any(each.here for each in known),
            stops=known,
        )

    def stop(self, reason: str) -> None:
        """Lock, repeating the request until every lock has acknowledged it."""
        self._want(STOP, reason)

    def release(self, others: Sequence[str] = ()) -> None:
        """Withdraw our own stop, and the stops of others by their keys; the remaining stops hold."""
        self._of = (self._key, *others)
        self._want(RELEASE, "")

    def _want(self, verb: str, reason: str) -> None:
        self._wanted, self._reason, self._since = verb, reason, time.monotonic()
        self._send(verb, reason)
        self._update()

    def steer(self) -> None:
        """Claim the steering; to be repeated by whoever sees that a person is there."""
        now = time.monotonic()
        if not self.steering or now - self._steered >= HEARTBEAT:
            self.steering, self._steered = True, now
            self._send(STEER, "")

    @property
    def stopping(self) -> bool:
        """Whether a requested stop has not been acknowledged yet."""
        return self._wanted == STOP

    @property
    def releasing(self) -> bool:
        """Whether a requested release has not been acknowledged yet."""
        return self._wanted == RELEASE

    @property
    def heard(self) -> bool:
        """Whether every lock that was found has reported its state."""
        return all(each in self._states for each in list(self._watching))

    def hand_back(self) -> None:
        """Hand the steering back."""
        if self.steering:
            self.steering = False
            self._send(HAND_BACK, "")

    def repeat(self) -> None:
        """Repeat what has not been acknowledged; to be called ten times a second."""
        if self._wanted == RELEASE and time.monotonic() - self._since > PATIENCE:
            self._wanted = ""
        if self._wanted:
            self._send(self._wanted, self._reason)

    def _send(self, verb: str, reason: str) -> None:
        for publisher in list(self._requests.values()):
            try:
                publisher.publish(self._message(verb, self.holder, reason))
            except (TypeError, ValueError):  # a text that cannot be sent: the request counts, not by whom and why
                publisher.publish(self._message(verb, "", ""))

    def _message(self, verb: str, holder: str, reason: str) -> DiagnosticStatus:
        values = [KeyValue(key=REQUEST, value=verb)]
        if verb == RELEASE:
            values.append(KeyValue(key="of", value=json.dumps(self._of)))
        return DiagnosticStatus(
            level=DiagnosticStatus.WARN,
            name=holder,
            message=encodable(reason),
            hardware_id=self._key,
            values=values,
        )


def user() -> str:
    """The person at this machine, as others read it; encodable, whatever the environment contains."""
    try:
        name = getpass.getuser()
    except (KeyError, OSError):  # a user id without a name, as in containers
        name = str(os.getuid())
    return encodable(f"{name}@{platform.node()}")


def _stops(state: Mapping[str, str], own: str) -> list[RobotStop]:
    """The stops in a lock's report; a lock that only tells who holds it has one stop, which is everybody's."""
    try:
        entries = json.loads(state.get("stops", ""))
        found = [[str(part) for part in entry[:3]] for entry in entries if len(entry) >= 3]
    except (ValueError, TypeError, KeyError, RecursionError):
        found = []
    found = found or [["", state.get("holder", ""), state.get("reason", "")]]
    return [RobotStop(key, holder, reason, here=key == own, by_node=key == NODE) for key, holder, reason in found]
