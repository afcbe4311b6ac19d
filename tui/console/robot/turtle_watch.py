"""Watches turtles: their poses, and what they have drawn.

Any `turtlesim` is recognised by the type of its poses. If there is no hidden topic with the drawing, short trails are
shown.
"""

from __future__ import annotations

import math
from collections import deque
from functools import partial
from typing import Any

from bot_console.tui.console.model import GraphInfo, NodeInfo
from bot_console.tui.console.robot.robot_model import Drawing, Pose, Turtle, TurtleField
from bot_console.tui.console.topics.interfaces import interface
from bot_console.tui.console.topics.port import Payload
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

POSE, IMAGE = "turtlesim/msg/Pose", "sensor_msgs/msg/Image"
CANVAS = "_canvas"
"""The last token of the hidden topic on which our own turtlesim publishes its drawing."""
MAX_TRAIL_POINTS, TRAIL_STEP_M = 400, 0.1
"""The number of points of a trail, and the distance between two of them in m."""
NEWEST = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class TurtleWatch:
    """Keeps the newest pose of each turtle and the newest drawing of each field while they are in the graph."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._subscriptions: dict[str, Any] = {}
        self._names: dict[str, dict[str, str]] = {}
        self._canvases: dict[str, str] = {}
        self._poses: dict[str, Any] = {}
        self._trails: dict[str, deque[tuple[float, float]]] = {}
        self._drawings: dict[str, Drawing] = {}
        self.fresh = False
        """Whether there is something new since the last call of `fields`."""

    def follow(self, graph: GraphInfo) -> None:
        """Subscribe to the turtles in the graph, and forget those that have left."""
        names = {node.name: _turtles(node) for node in graph.nodes if _topics(node, POSE)}
        canvases = {name: topic for node in graph.nodes if (name := node.name) in names for topic in _canvas(node)}
        if (names, canvases) == (self._names, self._canvases):
            return
        self._names, self._canvases, self.fresh = names, canvases, True
        poses = {topic for turtles in names.values() for topic in turtles}
        for topic in self._subscriptions.keys() - poses - set(canvases.values()):
            self._node.destroy_subscription(self._subscriptions.pop(topic))
            for kept in (self._poses, self._trails, self._drawings):
                kept.pop(topic, None)
        for topic in poses - self._subscriptions.keys():
            self._subscribe_pose(topic)
        for topic in set(canvases.values()) - self._subscriptions.keys():
            self._subscribe_canvas(topic)

    def _subscribe_pose(self, topic: str) -> None:
        try:
            kind = interface(Payload.MESSAGE, POSE)
        except ValueError:  # the turtles run on another machine, and turtlesim is not installed here
            return
        self._trails[topic] = deque(maxlen=MAX_TRAIL_POINTS)
        self._subscriptions[topic] = self._node.create_subscription(kind, topic, partial(self._on_pose, topic), NEWEST)

    def _subscribe_canvas(self, topic: str) -> None:
        from sensor_msgs.msg import Image

        self._subscriptions[topic] = self._node.create_subscription(
            Image, topic, partial(self._on_canvas, topic), LATCHED
        )

    def _on_pose(self, topic: str, message: Any) -> None:
        if not (math.isfinite(message.x) and math.isfinite(message.y)):
            return
        trail = self._trails[topic]
        if not trail or math.dist(trail[-1], (message.x, message.y)) >= TRAIL_STEP_M:
            trail.append((message.x, message.y))
        if message != self._poses.get(topic):
            self._poses[topic] = message
            self.fresh = True

    def _on_canvas(self, topic: str, message: Any) -> None:
        if message.encoding == "rgba8" and 0 < len(message.data) == 4 * message.width * message.height:
            self._drawings[topic] = Drawing(message.width, message.height, bytes(message.data))
            self.fresh = True

    def fields(self) -> tuple[TurtleField, ...]:
        """All fields with their turtles, sorted by node name."""
        self.fresh = False
        return tuple(self._field(node) for node in sorted(self._names))

    def _field(self, node: str) -> TurtleField:
        canvas = self._canvases.get(node)
        turtles: list[Turtle] = []
        for topic, name in sorted(self._names[node].items(), key=lambda each: each[1]):
            message = self._poses.get(topic)
            if message is not None:
                pose = Pose(message.x, message.y, message.theta)
                trail = () if canvas else tuple(self._trails[topic])
                turtles.append(Turtle(name, pose, message.linear_velocity, message.angular_velocity, trail))
        return TurtleField(node, tuple(turtles), self._drawings.get(canvas) if canvas else None)


def _topics(node: NodeInfo, kind: str) -> list[str]:
    return [each.name for each in node.publishers if kind in each.types]


def _turtles(node: NodeInfo) -> dict[str, str]:
    """The names of a node's turtles by their pose topics, without the node's namespace."""
    space = node.name.rpartition("/")[0] + "/"
    return {topic: topic.removeprefix(space).strip("/").removesuffix("/pose") for topic in _topics(node, POSE)}


def _canvas(node: NodeInfo) -> list[str]:
    return [each for each in _topics(node, IMAGE) if each == f"{node.name}/{CANVAS}"]
