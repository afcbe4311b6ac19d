"""The console's link to the robot's emergency stop: sends requests, and tracks what every lock has acknowledged.

The interface is that of `docs/safety.md`; a robot without it is stopped by zero velocities, which nothing acknowledges.
"""

from __future__ import annotations

import getpass
import json
import os
import platform
import threading
import time
import uuid
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from bot_console.tui.console.robot.lock_state import NODE, LockState
from bot_console.tui.console.robot.robot_model import RobotStop
from bot_console.tui.text.encodable import encodable
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile

STATUS = "diagnostic_msgs/msg/DiagnosticStatus"
FOLDER, REQUEST = "/emergency_stop/", "request"
STOP, RELEASE, STEER, HAND_BACK = "stop", "release", "steer", "hand_back"
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
HEARTBEAT_S = 0.2
"""Seconds between two claims of control; after 1 s without one, the robot locks itself."""
RELEASE_TIMEOUT_S = 2.0
"""Seconds for which a release is repeated if the lock does not report; a lock that reports may take any time."""
REMINDER_S = 1.0
"""Seconds between two copies of a stop that every lock has acknowledged, since a lock may lose it unnoticed."""
REPORT_TIMEOUT_S = 3.0
"""Seconds without a report after which a lock no longer confirms a stop. Every lock except older ones reports once a
second.
"""
UNANSWERED = "a release was not answered"
"""The reason of the stop that follows an abandoned release."""
MIN_REPEAT_S = 0.05
"""Minimum seconds between two copies of a stop, for a lock that keeps reporting that it does not have it."""


MAX_NAME_CHARS = 200
"""Maximum characters of a holder and a key: locks cut off the rest, and would report the stop as somebody else's."""


@dataclass(frozen=True, slots=True)
class StopInfo:
    """What is known of the stop: whether it is requested or reported, acknowledged by every lock, by whom and why."""

    stopped: bool = False
    confirmed: bool = False
    holder: str = ""
    reason: str = ""
    steered_by: str = ""
    locks: int = 0
    here: bool = False
    """Whether one of the stops is our own."""
    own: frozenset[str] = frozenset()
    """The ids of our own stops, except those made by `add_stop` and those that are being released.

    A lock itself adds one in our name if we had control and fell silent.
    """
    stops: tuple[RobotStop, ...] = ()
    """Everybody's stops, oldest first."""


@dataclass(frozen=True, slots=True)
class RequestedStop:
    """A stop requested here, which is sent to every lock that lacks it until somebody has released it."""

    reason: str
    kept: bool
    alone: bool = False
    """Whether it is separate from the requester's other stops, so that only `withdraw` ends it."""


class StopLink:
    """Sends requests to all locks of the robots in the graph, repeatedly until they acknowledge.

    A stop is requested until it is released, either here or by somebody else, which a lock reports. Until then it is
    sent to every lock that appears without it or loses it.

    `stop`, `release`, `withdraw`, `steer` and `hand_back` may be called from any thread and send at once.
    """

    def __init__(self, node: Node, holder: str = "", key: str = "") -> None:
        """`key` distinguishes this requester's stops from those of others; by default it is random."""
        self._node = node
        self.holder = encodable(holder)[:MAX_NAME_CHARS] or f"bot-console of {user()} (pid {os.getpid()})"
        self._key = encodable(key)[:MAX_NAME_CHARS] or uuid.uuid4().hex
        self._watching: dict[str, Any] = {}
        self._watches: dict[str, object] = {}
        """An object for each topic that distinguishes its present subscription from earlier ones."""
        self._states: dict[str, LockState] = {}
        self._reported_at: dict[str, float] = {}
        self._requests: dict[str, Any] = {}
        self._requested: dict[str, RequestedStop] = {}
        self._acknowledged: dict[tuple[str, str], str] = {}
        """The instance of an older lock that held a stop, by the topic of the lock and the id of the stop."""
        self._sent_at = 0.0
        self._releasing: frozenset[str] = frozenset()
        """The ids of stops to release; for older locks the keys of their requesters."""
        self._releasing_own: frozenset[str] = frozenset()
        """The part of `_releasing` that consists of this requester's own stops."""
        self._release_until = 0.0
        self._withdrawn: frozenset[str] = frozenset()
        """The ids of this requester's stops that `release` has ended last, not those that `withdraw` has ended."""
        self._steered_at = 0.0
        self.steering = False
        """Whether this console has control of the robot."""
        self._changed = threading.Condition()
        self.info = StopInfo()

    def follow(self, topics: Iterable[str]) -> None:
        """Watch the locks among these topics, whose type is `DiagnosticStatus`."""
        found = {each for each in topics if is_lock(each)}
        for gone in set(self._watching) - found:
            with self._changed:
                self._watches.pop(gone)
                self._states.pop(gone, None)
                self._reported_at.pop(gone, None)
            self._node.destroy_subscription(self._watching.pop(gone))
        for topic in found - set(self._watching):
            requests = topic.rpartition("/")[0] + "/" + REQUEST
            if requests not in self._requests:
                self._requests[requests] = self._node.create_publisher(DiagnosticStatus, requests, 10)
            self._watches[topic] = watch = object()
            self._watching[topic] = self._node.create_subscription(
                DiagnosticStatus, topic, partial(self._on_state, topic, watch), LATCHED
            )
        self._update()

    def _on_state(self, topic: str, watch: object, message: DiagnosticStatus) -> None:
        state = LockState.of({each.key: each.value for each in message.values})
        with self._changed:
            if self._watches.get(topic) is not watch:
                return  # from a destroyed subscription: nothing would ever replace this state
            self._states[topic] = state
            self._reported_at[topic] = time.monotonic()
        self._update()
        if self.stopping and time.monotonic() - self._sent_at >= MIN_REPEAT_S:
            self._send_stops()

    def _update(self) -> None:
        with self._changed:  # so that an older state does not replace a newer one
            self._drop_released()
            self._refresh()
            self._changed.notify_all()

    def await_held(self, timeout_s: float) -> bool:
        """Wait, at most `timeout_s`, until every lock holds and has acknowledged the stops; returns whether that is
        so.
        """
        with self._changed:
            return self._changed.wait_for(lambda: self.info.confirmed, timeout_s)

    def _drop_released(self) -> None:
        """Forget the stops that somebody has released. A lock that merely lacks a stop has not received it, or has
        restarted.

        An older lock reports no releases: there a stop counts as released if the same instance of the lock had it and
        no longer does.
        """
        for id in list(self._requested):
            if any(self._was_released(id, topic, state) for topic, state in list(self._states.items())):
                del self._requested[id]
                self._acknowledged = {at: instance for at, instance in self._acknowledged.items() if at[1] != id}

    def _was_released(self, id: str, topic: str, state: LockState) -> bool:
        if state.released is not None:
            return id in state.released
        if state.holds(id, self._key):
            self._acknowledged[topic, id] = state.instance
            return False
        return state.has_reported and self._acknowledged.get((topic, id)) == state.instance

    def _refresh(self) -> None:
        states = [self._states.get(each, LockState()) for each in list(self._watching)]
        held = bool(states) and all(each.locked for each in states)
        confirmed = held and all(state.holds(id, self._key) for state in states for id in self._requested)
        confirmed = confirmed and not self._silent_locks()
        if states and all(each.has_reported and self._has_released(each) for each in states):
            self._releasing = frozenset()
        known = {each.id: each for state in states for each in state.stops}
        stops = tuple(
            RobotStop(each.id, each.holder, each.reason, here=self._is_own(each.id, each.key), by_node=each.key == NODE)
            for each in known.values()
        )
        own = next(iter(self._requested.values()), None)
        self.info = StopInfo(
            stopped=bool(known) or own is not None,
            confirmed=confirmed,
            holder=stops[0].holder if stops else "",
            reason=stops[0].reason if stops else own.reason if own else "",
            steered_by=next((each.steered_by for each in states if each.steered_by), ""),
            locks=len(states),
            here=own is not None or any(each.here for each in stops),
            own=frozenset(id for id, each in self._requested.items() if not each.alone) | self._made_by_locks(states),
            stops=stops,
        )

    def _made_by_locks(self, states: Sequence[LockState]) -> frozenset[str]:
        """The ids of stops that locks hold in our name without a request, unless their release is on its way."""
        if self._key in self._releasing:
            return frozenset()
        ours = {each.id for state in states for each in state.stops if each.key == self._key and each.id}
        released = {id for state in states for id in state.released or ()}
        return frozenset(ours - self._requested.keys() - self._releasing - released)

    def _silent_locks(self) -> list[str]:
        """The topics of locks that should report once a second but do not; they may be frozen or gone."""
        due, states = time.monotonic() - REPORT_TIMEOUT_S, list(self._states.items())
        return [each for each, state in states if state.released is not None and self._reported_at.get(each, 0) < due]

    def _is_own(self, id: str, key: str) -> bool:
        return key == self._key or id in self._requested

    def _has_released(self, state: LockState) -> bool:
        """Whether a lock has acknowledged the release. It is not enough that it lacks the stops: they may be on their
        way.

        An older lock reports no releases, and does not distinguish the stops of a key.
        """
        if state.released is not None:
            return self._releasing - {self._key} <= state.released.keys()
        return not any(each.id in self._releasing or not each.id for each in state.stops)

    def stop(self, reason: str, *, kept: bool = True) -> str:
        """Lock the robot until released; returns the id of the stop, which stays the same while a stop of its kind
        holds.

        A stop that is not `kept` ends with the robot's nodes, unless this requester is still there to repeat it.
        """
        with self._changed:
            id = next((id for id, each in self._requested.items() if each.kept is kept and not each.alone), "")
            return self._request(id or uuid.uuid4().hex, RequestedStop(reason, kept))

    def add_stop(self, reason: str, *, kept: bool = True) -> str:
        """Lock the robot with a separate stop, which `withdraw` can end alone; returns its id."""
        return self._request(uuid.uuid4().hex, RequestedStop(reason, kept, alone=True))

    def join(self, id: str) -> None:
        """Turn a stop made by `add_stop` into an ordinary stop of this requester."""
        with self._changed:
            if id in self._requested:
                self._requested[id] = replace(self._requested[id], alone=False)
        self._update()

    def _request(self, id: str, stop: RequestedStop) -> str:
        with self._changed:
            self._requested.setdefault(id, stop)
            # Neither our key, which an older lock would take for a release of this stop too, nor the stops of others.
            self._releasing &= self._releasing_own
        self._send_stops()
        self._update()
        return id

    def release(self, others: Iterable[str] = ()) -> None:
        """Release our own stops except separate ones, and the stops of others with these ids."""
        with self._changed:
            own = {each.id for state in self._states.values() for each in state.stops if each.key == self._key}
            left = {id: each for id, each in self._requested.items() if each.alone}
            self._withdrawn = (self._withdrawn & self._releasing) | (self._requested.keys() - left.keys())
            ids = {*self._requested, *own, *others} - left.keys()
            self._requested = left
        self._release(ids, ids - set(others))

    def withdraw(self, id: str) -> None:
        """Release a single stop of our own."""
        with self._changed:
            self._requested.pop(id, None)
        self._release({id}, {id})

    def _release(self, ids: Collection[str], own: Collection[str]) -> None:
        """Release these stops, in addition to those of an earlier release that are not acknowledged yet."""
        with self._changed:
            # For an older lock our key stands for all our stops, so it is released with the last of them.
            self._releasing = self._releasing.union(ids if self._requested else {*ids, self._key})
            self._releasing_own = self._releasing & self._releasing_own.union(own)
        self._release_until = time.monotonic() + RELEASE_TIMEOUT_S
        self._send_release()
        self._update()

    def steer(self) -> None:
        """Claim control of the robot; to be repeated as long as a person is known to be present."""
        now = time.monotonic()
        if not self.steering or now - self._steered_at >= HEARTBEAT_S:
            self.steering, self._steered_at = True, now
            self._send(STEER, "", {"id": uuid.uuid4().hex})

    @property
    def has_stop(self) -> bool:
        """Whether this requester has requested a stop."""
        return bool(self._requested)

    @property
    def stopping(self) -> bool:
        """Whether a requested stop has not been acknowledged by every lock."""
        return bool(self._requested) and not self.info.confirmed

    @property
    def releasing(self) -> bool:
        """Whether a requested release has not been acknowledged yet."""
        return bool(self._releasing)

    @property
    def has_reported(self) -> bool:
        """Whether every lock that was found has reported its state."""
        return all(each in self._states for each in list(self._watching))

    def hand_back(self) -> None:
        """Hand back control of the robot."""
        if self.steering:
            self.steering = False
            self._send(HAND_BACK, "", {})

    def repeat(self) -> None:
        """Repeat requests that are not acknowledged; to be called ten times a second."""
        now = time.monotonic()
        if now > self._release_until:
            if self._withdrawn & self._releasing and self._silent_locks():
                # The release may be waiting in a slow link and let the robot go unexpectedly, so a stop follows it.
                self.stop(UNANSWERED)
            self._releasing &= self._still_held()
        if self._releasing:
            self._send_release()
        if self.info.confirmed and self._silent_locks():
            self._update()
        if self.stopping or now - self._sent_at >= REMINDER_S:
            self._send_stops()

    def _still_held(self) -> frozenset[str]:
        """The ids of stops that locks still report; none once a lock is silent, since a late release would be
        unexpected.

        A lock on a busy machine may need longer for a release, and refuses it whenever its challenge has changed.
        """
        if self._silent_locks():
            return frozenset()
        states = [each for each in list(self._states.values()) if each.released is not None]
        return frozenset(each.id for state in states for each in state.stops)

    def _send_stops(self) -> None:
        self._sent_at = time.monotonic()
        for id, stop in list(self._requested.items()):
            self._send(STOP, stop.reason, {"id": id} if stop.kept else {"id": id, "kept": "false"})

    def _send_release(self) -> None:
        names = sorted(self._releasing)  # older locks read the keys from these
        challenges = [each.challenge for each in list(self._states.values()) if each.challenge]
        lists = {"of": names, "ids": [each for each in names if each != self._key], "challenges": challenges}
        self._send(RELEASE, "", {key: json.dumps(each) for key, each in lists.items()})

    def _send(self, verb: str, reason: str, values: Mapping[str, str]) -> None:
        for publisher in list(self._requests.values()):
            try:
                publisher.publish(self._message(verb, self.holder, reason, values))
            except (TypeError, ValueError):  # a text cannot be sent: the request matters, not its holder and reason
                publisher.publish(self._message(verb, "", "", values))

    def _message(self, verb: str, holder: str, reason: str, values: Mapping[str, str]) -> DiagnosticStatus:
        return DiagnosticStatus(
            level=DiagnosticStatus.WARN,
            name=holder,
            message=encodable(reason),
            hardware_id=self._key,
            values=[KeyValue(key=key, value=value) for key, value in {REQUEST: verb, **values}.items()],
        )


def is_lock(topic: str) -> bool:
    """Whether a lock reports its state on this topic of type `DiagnosticStatus`."""
    return FOLDER in topic and not topic.endswith(FOLDER + REQUEST)


def user() -> str:
    """The user and the machine, as shown to others; encodable, whatever the environment contains."""
    try:
        name = getpass.getuser()
    except (KeyError, OSError):  # a user id without a name, as in containers
        name = str(os.getuid())
    return encodable(f"{name}@{platform.node()}")
