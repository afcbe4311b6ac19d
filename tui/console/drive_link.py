"""Velocity commands from the console, and what became of them on their way to the robot."""

from __future__ import annotations

import math
import time
from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

from bot_console.tui.console.model import DriveInfo, GraphInfo
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Twist
from rclpy.node import Node

TELEOP = "cmd_vel_teleop"
FINAL = "cmd_vel"
ASKED = "cmd_vel_nav"
TWIST = "geometry_msgs/msg/Twist"
HOLD_PERIOD = 0.1
"""Seconds between two zeros while the all-stop holds; below the 0.5 s after which a command is dead."""

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
        self._held = False
        self._verdict = Verdict()
        self._heard = 0.0
        self._info = DriveInfo()
        self._topics: dict[str, str] = {}
        self._arbitrated = False
        node.create_timer(HOLD_PERIOD, self._hold_still)

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
        if token == FINAL and self._held and velocity != (0.0, 0.0):
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
        """Publish one command (m/s, rad/s), unless the all-stop holds; raises `ValueError` for NaN and infinity."""
        if not (math.isfinite(linear) and math.isfinite(angular)):
            raise ValueError("a velocity must be a finite number")
        if not self._held:
            self._send(self._token, linear, angular)

    def stop(self, hold: bool) -> None:
        """Zero velocity on every command topic, now and, while held, again and again."""
        self._held = hold
        self.zero()

    def zero(self) -> None:
        """One zero Twist to every topic on which a robot or its arbiter listens."""
        for token in (TELEOP, FINAL):
            self._send(token, 0.0, 0.0)

    def _hold_still(self) -> None:
        if self._held:
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
        info = DriveInfo(
            topic=self.topic,
            asked=self._verdict.asked or self._seen.get(ASKED),
            limited=self._verdict.limited,
            final=None if silent else self._seen.get(FINAL),
            actual=actual,
            limited_by=why,
            stopped=self._held,
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
