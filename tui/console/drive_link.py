"""Velocity commands from the console, and what became of them on their way to the robot."""

from __future__ import annotations

import math
import time
from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

from bot_console.tui.console.model import GraphInfo
from bot_console.tui.console.robot_model import DriveInfo
from bot_console.tui.console.stop_link import STATUS, StopLink
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Twist
from rclpy.node import Node

TELEOP = "cmd_vel_teleop"
FINAL = "cmd_vel"
ASKED = "cmd_vel_nav"
TWIST = "geometry_msgs/msg/Twist"
HOLD_PERIOD = 0.1
"""Seconds between two zeros, or requests, while a stop is not acknowledged; a command is dead after 0.5 s."""

VERDICT = "diagnostics"
DIAGNOSTICS = "diagnostic_msgs/msg/DiagnosticArray"
SILENCE = 0.5
"""Seconds after which a velocity command is dead, and the robot stops by itself."""
NO_COMMAND = "no command on cmd_vel for 0.5 s"
NO_ARBITER = "the node that takes cmd_vel_teleop has ended; start it again to drive"

Velocity = tuple[float, float]


@dataclass(frozen=True)
class Verdict:
    """What an arbiter made of the command that it chose: the rule or parameter that limited it, and what was left."""

    limited_by: str = ""
    asked: Velocity | None = None
    limited: Velocity | None = None


class DriveLink:
    """Publishes Twists where the robot listens for a person, and watches the command chain.

    `drive` and `stop` may be called from any thread.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._publishers: dict[str, Any] = {}
        self._watching: dict[str, Any] = {}
        self._seen: dict[str, Velocity] = {}
        self._stop = StopLink(node)
        self._zeros = False
        self._verdict = Verdict()
        self._heard = 0.0
        self._info = DriveInfo()
        self._topics: dict[str, str] = {}
        self._arbitrated = False
        node.create_timer(HOLD_PERIOD, self._repeat)

    def follow(self, graph: GraphInfo) -> None:
        """Find the robot's command topics by their last token, in whatever namespace."""
        subscribed = {each.name for node in graph.nodes for each in node.subscriptions if TWIST in each.types}
        published = {each.name for node in graph.nodes for each in node.publishers if TWIST in each.types}
        had_arbiter = bool(self._topics.get(TELEOP))
        for token in (TELEOP, FINAL):
            self._topics[token] = _topic(subscribed, token)
        if had_arbiter and not self._topics[TELEOP]:
            self.zero()  # it need not wait until its last command is dead
        self._arbitrated = bool(self._topics[TELEOP]) or (self._arbitrated and bool(self._topics[FINAL]))
        for token in (FINAL, ASKED):
            self._watch(token, _topic(published | subscribed, token))
        self._stop.follow(each.name for node in graph.nodes for each in node.publishers if STATUS in each.types)
        told = {each.name for node in graph.nodes for each in node.publishers if DIAGNOSTICS in each.types}
        self._watch(VERDICT, _topic(told, VERDICT))

    def _watch(self, token: str, topic: str) -> None:
        now = self._watching.get(token)
        if (now.topic_name if now else "") == topic:
            return
        if now:
            self._node.destroy_subscription(now)
            del self._watching[token]
            self._seen.pop(token, None)
        if token == VERDICT:
            self._verdict = Verdict()
            if topic:
                self._watching[token] = self._node.create_subscription(DiagnosticArray, topic, self._told, 10)
        elif topic:
            self._watching[token] = self._node.create_subscription(Twist, topic, partial(self._saw, token), 10)

    def _told(self, message: DiagnosticArray) -> None:
        """What an arbiter of velocities says about its last decision."""
        for status in message.status:
            values = {each.key: each.value for each in status.values}
            if "limited_by" in values:
                self._verdict = Verdict(values["limited_by"], _velocity(values, "asked"), _velocity(values, "final"))

    def _saw(self, token: str, message: Twist) -> None:
        velocity = (message.linear.x, message.angular.z)
        self._seen[token] = velocity
        if token == FINAL:
            self._heard = time.monotonic()
        if token == FINAL and self._zeros and velocity != (0.0, 0.0):
            # Somebody else drives on; without an arbiter the last word counts, so ours follows at once.
            self._send(FINAL, 0.0, 0.0)

    @property
    def topic(self) -> str:
        """Where commands of this console go; empty when no robot listens."""
        return self._topics.get(self._token, "")

    @property
    def _token(self) -> str:
        """A robot whose arbiter has left is not driven past it: what kept it safe is gone."""
        return TELEOP if self._arbitrated else FINAL

    def drive(self, linear: float, angular: float) -> None:
        """Publish one command (m/s, rad/s), unless the robot is held; raises `ValueError` for NaN and infinity."""
        if not (math.isfinite(linear) and math.isfinite(angular)):
            raise ValueError("a velocity must be a finite number")
        if not (self._stop.info.stopped or self._zeros):
            self._send(self._token, linear, angular)

    def stop(self, hold: bool, reason: str) -> None:
        """Lock the robot or let it go, and zero velocity now; a robot without a lock gets zeros again and again."""
        if hold:
            self._stop.stop(reason)
        else:
            self._stop.release()
        self._zeros = hold
        self.zero()

    def steer(self, hold: bool) -> None:
        """Say that a person holds the steering, or does no more; while held to be called ten times a second."""
        if hold:
            self._stop.steer()
        else:
            self._stop.hand_back()

    def close(self) -> None:
        """The last word: zero velocity, and a lock where this console leaves while it holds the steering."""
        if self._stop.steering:
            self._stop.stop("the console that held the steering was closed")
        self.zero()

    def zero(self) -> None:
        """One zero Twist to every topic on which a robot or its arbiter listens."""
        for token in (TELEOP, FINAL):
            self._send(token, 0.0, 0.0)

    def _repeat(self) -> None:
        self._stop.repeat()
        if self._stop.info.locks:
            self._zeros = False  # a lock needs no zeros, and they would keep a robot that somebody else has released
        if self._zeros:
            self._send(TELEOP if self._topics.get(TELEOP) else FINAL, 0.0, 0.0)

    def _send(self, token: str, linear: float, angular: float) -> None:
        topic = self._topics.get(token)
        if not topic:
            return
        publisher = self._publishers.get(topic)
        if publisher is None:
            publisher = self._publishers[topic] = self._node.create_publisher(Twist, topic, 10)
        message = Twist()
        message.linear.x = float(linear)
        message.angular.z = float(angular)
        publisher.publish(message)

    def info(self, actual: Velocity | None) -> DriveInfo:
        """The chain as known now; the same object while nothing changes."""
        silent = FINAL in self._seen and time.monotonic() - self._heard > SILENCE
        why = NO_COMMAND if silent else self._verdict.limited_by
        if self._arbitrated and not self._topics[TELEOP]:
            why = NO_ARBITER
        stop = self._stop.info
        info = DriveInfo(
            topic=self.topic,
            asked=self._verdict.asked or self._seen.get(ASKED),
            limited=self._verdict.limited,
            final=None if silent else self._seen.get(FINAL),
            actual=actual,
            limited_by=why,
            stopped=stop.stopped or self._zeros,
            stop_confirmed=stop.confirmed,
            stop_holder="this console" if stop.holder == self._stop.holder else stop.holder,
            stop_reason=stop.reason,
            lockable=stop.locks > 0,
            steered_by=stop.steered_by,
        )
        if info != self._info:
            self._info = info
        return self._info


def _topic(names: set[str], token: str) -> str:
    """The shortest topic that ends in a token; empty when there is none."""
    fitting = [name for name in names if name.rsplit("/", 1)[-1] == token]
    return min(fitting, key=lambda name: (len(name), name), default="")


def _velocity(values: Mapping[str, str], prefix: str) -> Velocity | None:
    """A velocity written out under `<prefix>.linear` and `<prefix>.angular`; None where that is not there."""
    try:
        return float(values[f"{prefix}.linear"]), float(values[f"{prefix}.angular"])
    except (KeyError, ValueError):
        return None
