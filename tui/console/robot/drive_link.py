"""Sends the console's velocity commands, and follows them on their way to the robot."""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable, Iterable, Sequence, Set
from dataclasses import dataclass
from functools import partial
from typing import Any

from bot_console.tui.console.model import GraphInfo
from bot_console.tui.console.robot.arbiter_report import Velocity, Verdict
from bot_console.tui.console.robot.command_topics import (
    ASKED,
    FINAL,
    NOBODY,
    STAMPED,
    TELEOP,
    CommandTopics,
)
from bot_console.tui.console.robot.early_stops import EarlyStops
from bot_console.tui.console.robot.fleet import Fleet, Published, Scope, driven_robot
from bot_console.tui.console.robot.robot_model import DriveInfo, WorldInfo
from bot_console.tui.console.robot.stop_holders import mark_gone
from bot_console.tui.console.robot.stop_link import STATUS, StopLink, is_lock
from bot_console.tui.console.robot.stop_means.configured import ConfiguredMeans
from bot_console.tui.console.robot.stop_means.means import means_of
from bot_console.tui.console.robot.stop_means.sequence import StopSequence
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Twist, TwistStamped
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy

HOLD_PERIOD_S = 0.1
"""Seconds between two zeros or requests while a stop is not acknowledged; a command expires after 0.5 s."""

BY_PERSON = "ALL STOP"
"""The reason of a stop that a person has requested by key."""

VERDICT = "diagnostics"
DIAGNOSTICS = "diagnostic_msgs/msg/DiagnosticArray"
VERDICT_LIFETIME_S = 2.0
"""Seconds after which a verdict is no longer shown: diagnostics are published at least once a second."""
SEARCH_S = 4.0
"""Seconds during which the graph may still lack robots and locks: programs announce theirs one by one, and on a busy
machine with pauses.
"""
COMMAND_LIFETIME_S = 0.5
"""Seconds after which a velocity command expires and the robot stops by itself."""
CLOCK = "/clock"
FORCED = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
"""This profile is compatible with every publisher, whatever it offers."""
NO_COMMAND = "no command on cmd_vel for 0.5 s"
NO_ARBITER = "the node that takes cmd_vel_teleop has ended; start it again to drive"


@dataclass(frozen=True)
class GraphRobots:
    """The robots in a graph."""

    fleet: Fleet
    locks: Published
    """The topics on which locks report their states."""
    verdicts: Published
    """The topics on which arbiters may report their decisions; found by type."""
    simulated: bool

    @classmethod
    def of(cls, graph: GraphInfo) -> GraphRobots:
        """Find the robots of a graph."""
        fleet = Fleet(graph)
        return cls(
            fleet,
            {each: nodes for each, nodes in fleet.published(STATUS).items() if is_lock(each)},
            fleet.published(DIAGNOSTICS),
            any(each.name == CLOCK for each in graph.topics),
        )


class DriveLink:
    """Publishes Twists on the topic on which the robot takes a person's commands, and watches the command chain.

    `drive`, `stop`, `hold_early` and `settle_early` may be called from any thread.
    """

    def __init__(
        self, node: Node, now: Callable[[], float] = time.monotonic, means: Sequence[ConfiguredMeans] = ()
    ) -> None:
        """`now` returns seconds, to measure the age of messages.

        `means` stop robots that have no lock.
        """
        self._node = node
        self._now = now
        self._publishers: dict[tuple[str, Any], Any] = {}
        self._watching: dict[str, Any] = {}
        self._seen: dict[str, Velocity] = {}
        self._stop = StopLink(node)
        self._early = EarlyStops(self._stop)
        self._zeros = False
        self._means = StopSequence([means_of(node, each) for each in means], now)
        self._unlocked: tuple[CommandTopics, ...] = ()
        self._without_lock: frozenset[str] = frozenset()
        """The robots without a lock, including those that have left since the stop: their drivers may come back."""
        self._verdict = Verdict()
        self._heard: dict[str, float] = {}
        self._info = DriveInfo()
        self._found = GraphRobots.of(GraphInfo())
        self._searching_until = math.inf
        """The time after which a robot that has not been found counts as absent; set with the first graph."""
        self._scope = Scope("/")
        self._robot = NOBODY
        self._chosen = ""
        self._replaced = False
        """Whether the driven robot left and another one took its place while somebody was driving."""
        self._acted = False
        self._arbitrated = False
        node.create_timer(HOLD_PERIOD_S, self._repeat)

    def follow(self, graph: GraphInfo) -> None:
        """Find the robots' command topics, and subscribe to those of the driven robot."""
        self.take(GraphRobots.of(graph))

    def take(self, found: GraphRobots) -> None:
        """Apply what was found in a graph; to be called in the thread that serves the node."""
        self._found = found
        self._searching_until = min(self._searching_until, self._now() + SEARCH_S)
        before = self._robot.robot
        self._follow_robot()
        self._replaced |= self._stop.steering and before not in ("", self._robot.robot)
        self._stop.follow(found.locks)
        present = tuple(self._each_robot())
        self._unlocked = tuple(each for each in present if not found.fleet.scope(each).own(found.locks))
        left = self._without_lock.difference(each.robot for each in present) if self._zeros else frozenset[str]()
        self._without_lock = left.union(each.robot for each in self._unlocked)

    def _follow_robot(self) -> None:
        found = self._found
        robot = driven_robot(found.fleet.robots, self._chosen)
        before, self._robot = self._robot, robot
        self._scope = found.fleet.scope(robot)
        if before.robot not in ("", robot.robot):
            self._arbitrated = False
        if before.get(TELEOP) and not robot.get(TELEOP):
            self.zero()  # so that the robot need not wait until its last command expires
        self._arbitrated = bool(robot.get(TELEOP)) or (self._arbitrated and bool(robot.get(FINAL)))
        named = {each for each in found.fleet.types if self._scope.owns(each)}
        for token in (FINAL, ASKED):
            self._watch(token, robot.get(FINAL) if not robot.standard and token == FINAL else _topic(named, token))
        self._watch(VERDICT, _topic(self._scope.own(found.verdicts), VERDICT))
        for each in (TELEOP, FINAL):
            if robot.get(each):
                self._publisher(robot.get(each))  # now: its first message must not precede its subscriptions

    def choose(self, robot: str) -> None:
        """Drive another of `DriveInfo.robots`; the previous one is sent a zero if this console drove it."""
        if robot != self._robot.robot:
            if self._acted:
                self.zero()
            self._chosen = robot
            self._replaced = False
            self._follow_robot()

    def _watch(self, token: str, topic: str) -> None:
        now = self._watching.get(token)
        if (now.topic_name if now else "") == topic:
            return
        if now:
            self._node.destroy_subscription(now)
            del self._watching[token]
            self._seen.pop(token, None)
            self._heard.pop(token, None)
        if token == VERDICT:
            self._verdict = Verdict()
            if topic:
                self._watching[token] = self._node.create_subscription(DiagnosticArray, topic, self._reported, 10)
        elif topic:
            self._watching[token] = self._node.create_subscription(
                self._twist_class(topic), topic, partial(self._record_command, token), FORCED
            )

    def _reported(self, message: DiagnosticArray) -> None:
        """Process the report of a velocity arbiter on its last decision."""
        for status in message.status:
            values = {each.key: each.value for each in status.values}
            if "limited_by" in values:
                self._verdict = Verdict.of(values)
                self._heard[VERDICT] = self._now()

    def _twist_class(self, topic: str) -> Any:
        return TwistStamped if self._found.fleet.types.get(topic) == STAMPED else Twist

    def _record_command(self, token: str, message: Any) -> None:
        twist = getattr(message, "twist", message)
        velocity = (twist.linear.x, twist.angular.z)
        self._seen[token] = velocity
        self._heard[token] = self._now()
        if token == FINAL and self._holds_by_zeros and (velocity != (0.0, 0.0) or twist.linear.y):
            # Somebody else keeps driving. Without an arbiter the last command counts, so ours follows at once.
            self._send(FINAL, 0.0, 0.0)

    @property
    def topic(self) -> str:
        """The topic of this console's commands; empty if no robot takes them."""
        return self._robot.get(self._token)

    @property
    def _token(self) -> str:
        """The last token of `topic`.

        A robot whose arbiter has left is not driven directly, because its protection is gone.
        """
        return TELEOP if self._arbitrated else FINAL

    def drive(self, linear: float, angular: float, sideways: float = 0.0) -> None:
        """Publish one command (m/s, rad/s; `sideways` in m/s to the left), unless the robot is stopped; raises
        `ValueError` for NaN and infinity.
        """
        if not all(map(math.isfinite, (linear, angular, sideways))):
            raise ValueError("a velocity must be a finite number")
        if not (self._stop.info.stopped or self._zeros or self._replaced):
            self._acted = True
            self._send(self._token, linear, angular, sideways)

    def stop(self, hold: bool, reason: str, others: Sequence[str] = ()) -> None:
        """Lock the robot or, without `hold`, release this console's stop and those of `others`; send zero velocity now.

        Only a stop that a person has requested outlives the robot's nodes; one that the console makes by itself does
        not. A robot without a lock is sent zeros repeatedly, and its configured means of stopping are tried in order.
        """
        if hold:
            self._stop.stop(reason, kept=reason == BY_PERSON)
        else:
            self._stop.release(others)
        self._acted = hold
        self._send_zeros(repeated=hold or bool(self._early))

    def _send_zeros(self, *, repeated: bool) -> None:
        """Send zero velocity now; with `repeated`, keep sending it to robots without a lock while a stop holds, and try
        their configured means.
        """
        self._zeros = repeated
        self._zero_all()
        if not repeated:
            self._means.release()
        elif self._needs_means:
            self._means.hold()

    def hold_early(self, press: str) -> None:
        """Stop the robot for a key press that has not been handled yet, with a separate stop."""
        self._early.hold(press)
        self._send_zeros(repeated=True)

    def settle_early(self, press: str, *, keep: bool) -> None:
        """Turn the stop for a key press into an ordinary stop of this console, or withdraw it and no other."""
        if self._early.settle(press, keep=keep):
            self._send_zeros(repeated=False)

    @property
    def steers(self) -> bool:
        """Whether this console claims control of the robot."""
        return self._stop.steering

    def steer(self, hold: bool) -> None:
        """Claim control of the robot, or hand it back; a claim has to be repeated ten times a second."""
        if hold:
            self._stop.steer()
        else:
            self._stop.hand_back()
            self._replaced = False

    def close(self, timeout_s: float = 0.0) -> None:
        """Send zero velocity, and lock the robot if this console leaves while it has control.

        A robot that was only watched is left alone, without waiting; for any other robot, wait as `await_standing`
        does.
        """
        steering, acted = self._stop.steering, self._acted
        if steering:
            self._stop.stop("the console that had control was closed")
        if acted:
            self.zero()
        if steering or acted:
            self.await_standing(timeout_s)

    def await_standing(self, timeout_s: float) -> None:
        """Wait until all locks hold the robot, at most `timeout_s`.

        Without a lock, wait the whole time, since nothing acknowledges a zero; but do not wait if nobody subscribes.
        """
        if self._stop.info.stopped and self._stop.info.locks:
            self._stop.await_held(timeout_s)
        elif self._is_heard():
            threading.Event().wait(timeout_s)

    def _is_heard(self) -> bool:
        """Whether anybody else subscribes to this console's commands."""
        own = [each.topic_name for each in list(self._watching.values())]
        published = list(self._publishers.values())
        return any(each.get_subscription_count() > own.count(each.topic_name) for each in published)

    def zero(self) -> None:
        """Send a zero to the topics to which the driven robot and its arbiter subscribe."""
        for token in (TELEOP, FINAL):
            self._send(token, 0.0, 0.0)

    def _each_robot(self) -> Iterable[CommandTopics]:
        """All robots whose topics have the usual names, and the driven robot."""
        every = {each.robot: each for each in (*self._found.fleet.robots, self._robot)}
        return [each for each in every.values() if each.standard or each is self._robot]

    def _zero_all(self) -> None:
        """Send a zero to all topics of all these robots."""
        for topic in (topic for robot in self._each_robot() for topic in robot.topics.values()):
            self._publish(topic, 0.0, 0.0)

    def _repeat(self) -> None:
        self._stop.repeat()
        if self._stop.has_stop and not (self._stop.info.locks or self._zeros):
            self._send_zeros(repeated=True)  # the last lock has left the graph
        if self._stop.info.locks and not (self._stop.stopping or (self._without_lock and self._stop.info.stopped)):
            # A locked robot needs no zeros, which would still hold it after somebody else has released the stop.
            self._zeros = False
            self._means.release()
        if self._stop.info.locks and self._stop.stopping:
            self._zero_all()  # until the lock has acknowledged: it may hang, or have ended without leaving the graph
        elif self._zeros:
            for robot in self._unlocked if self._stop.info.locks else self._each_robot():
                self._publish(robot.get(TELEOP) or robot.get(FINAL), 0.0, 0.0)
        if self._zeros and self._needs_means:
            self._means.tick()

    @property
    def _needs_means(self) -> bool:
        """Whether a robot has no lock, as far as is known; also true while no lock has been found at all."""
        return bool(self._without_lock) or not self._stop.info.locks

    @property
    def _holds_by_zeros(self) -> bool:
        """Whether zeros hold the driven robot: it has no lock, or not every lock has acknowledged our stop."""
        locked = self._stop.info.locks and self._robot not in self._unlocked
        return self._stop.stopping or (self._zeros and not locked)

    def _send(self, token: str, linear: float, angular: float, sideways: float = 0.0) -> None:
        self._publish(self._robot.get(token), linear, angular, sideways)

    def _publisher(self, topic: str) -> Any:
        key = (topic, self._twist_class(topic))
        if key not in self._publishers:
            self._publishers[key] = self._node.create_publisher(key[1], topic, 10)
        return self._publishers[key]

    def _publish(self, topic: str, linear: float, angular: float, sideways: float = 0.0) -> None:
        if not topic:
            return
        message = self._twist_class(topic)()
        twist = getattr(message, "twist", message)
        twist.linear.x, twist.linear.y, twist.angular.z = float(linear), float(sideways), float(angular)
        if twist is not message and not self._found.simulated:
            # With simulated time our own clock would give a wrong stamp; a stamp of zero means now.
            message.header.stamp = self._node.get_clock().now().to_msg()
        self._publisher(topic).publish(message)

    def _recent(self, token: str, lifetime_s: float) -> bool:
        """Whether a message on the topic with this token was received within the last `lifetime_s` seconds."""
        heard = self._heard.get(token)
        return heard is not None and self._now() - heard <= lifetime_s

    def info(self, world: WorldInfo) -> DriveInfo:
        """The state of the command chain, including the robot's own report; the same object while nothing changes."""
        here = world.robot in ("", self._robot.robot)
        final, asked = (self._recent(token, COMMAND_LIFETIME_S) for token in (FINAL, ASKED))
        silent = FINAL in self._seen and not final
        gone = silent and here and world.silent_s > 0
        verdict = self._verdict if self._recent(VERDICT, VERDICT_LIFETIME_S) else Verdict()
        why = NO_COMMAND if silent else verdict.limited_by
        if self._arbitrated and not self._robot.get(TELEOP):
            why = NO_ARBITER
        stop = self._stop.info
        info = DriveInfo(
            topic=self.topic,
            robot=self._robot.robot,
            robots=tuple(each.robot for each in self._found.fleet.robots),
            others=self._scope.others,
            asked=None if gone else verdict.asked or (self._seen[ASKED] if asked else None),
            limited=None if gone else verdict.limited,
            final=self._seen[FINAL] if final else None,
            actual=(world.speed, world.turn) if here and world.pose and not world.silent_s else None,
            silent_s=world.silent_s if here else 0,
            limited_by=why,
            stopped=stop.stopped or self._zeros,
            stop_confirmed=stop.confirmed if stop.locks else self._zeros and bool(self._means.holds),
            stop_holder="this console" if stop.holder == self._stop.holder else stop.holder,
            stop_reason=stop.reason,
            stopped_here=stop.here or self._zeros,
            own_stops=stop.own,
            press_waits=bool(self._early),
            stops=mark_gone(stop.stops),
            lockable=stop.locks > 0,
            unlocked=tuple(each.robot for each in self._unlocked),
            searching=self._now() < self._searching_until,
            held_by_means=self._means.holds,
            means_news=self._means.news,
            steered_by=stop.steered_by,
        )
        if info != self._info:
            self._info = info
        return self._info


def _topic(names: Set[str], token: str) -> str:
    """The shortest topic name that ends in a token; empty if there is none."""
    fitting = [name for name in names if name.rsplit("/", 1)[-1] == token]
    return min(fitting, key=lambda name: (len(name), name), default="")
