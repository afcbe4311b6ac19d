"""Collects the frames published on `/tf` and `/tf_static` while somebody is viewing them."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from bot_console.tui.console.model import GraphInfo
from bot_console.tui.console.sensors.frames import Frame, Frames
from bot_console.tui.console.topics.interfaces import interface
from bot_console.tui.console.topics.offered_topics import offered_qos
from bot_console.tui.console.topics.port import Payload
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy

if TYPE_CHECKING:  # a minimal ROS 2 installation has no tf2_msgs
    from geometry_msgs.msg import TransformStamped
    from tf2_msgs.msg import TFMessage

MOVING, FIXED = "/tf", "/tf_static"
TYPE = "tf2_msgs/msg/TFMessage"
DEPTH = {MOVING: 100, FIXED: 1000}
"""Queue depths: static transforms arrive all at once, and each only once."""
MAX_FRAMES = 2000
"""The number of frames kept."""
OTHER_PARENT_S = 5.0
"""Seconds that another parent on `/tf` is remembered; one on `/tf_static` is published only once, so it stays."""
WINDOW_S = 2.0
"""Seconds over which a rate is measured."""
JUMP_BACK_S = 1.0
"""How far back (s) a frame's stamps have to go to count as a jump of time: a reset, or a bag that starts again."""
SAME_CLOCK_S = 60.0
"""A stamp that differs by more than this (s) is considered to be from another clock."""


@dataclass
class _FrameState:
    """A frame as received: the newest transform, and the number of transforms since a time."""

    transform: TransformStamped
    fixed: bool
    last_received: float
    late: float
    count: int = 0
    since: float = 0.0
    rate: float | None = None
    parents: dict[str, float] = field(default_factory=dict[str, float])
    stamps: dict[str, float] = field(default_factory=dict[str, float])
    """The newest stamp (s) of the transforms from each parent, since two publishers may have two clocks."""


class FramesWatch:
    """Subscribes only while somebody is viewing the frames, since `/tf` may be the busiest topic of a robot."""

    def __init__(self, node: Node, clock: Callable[[], float] = time.monotonic) -> None:
        self._node = node
        self._clock = clock
        self._last_poll = False
        self._subscriptions: dict[str, tuple[object, Any]] = {}
        self._seen: dict[str, _FrameState] = {}
        self._publishers: dict[str, tuple[str, ...]] = {MOVING: (), FIXED: ()}
        self._dropped = 0
        self._problem = ""

    def poll(self, on: bool, graph: GraphInfo) -> None:
        """Start or stop listening; called by the executor."""
        self._last_poll = on
        if not on:
            self._seen.clear()
        self.follow(graph)

    def follow(self, graph: GraphInfo) -> None:
        """Process a changed graph; called by the executor."""
        for topic in self._publishers:
            nodes = [node.name for node in graph.nodes if any(each.name == topic for each in node.publishers)]
            self._publishers[topic] = tuple(nodes)
            offer = offered_qos(graph, topic) if nodes and self._last_poll else None
            before = self._subscriptions.get(topic)
            if before is not None and (offer is None or before[0] != offer.key):
                self._node.destroy_subscription(before[1])
                del self._subscriptions[topic]
            if offer is not None and topic not in self._subscriptions:
                self._subscribe(topic, offer.key, offer.profile())

    def _subscribe(self, topic: str, offer: object, profile: QoSProfile) -> None:
        try:
            kind = interface(Payload.MESSAGE, TYPE)
        except ValueError as error:
            self._problem = str(error)
            return
        profile.depth = DEPTH[topic]
        if topic == MOVING:
            profile.reliability = ReliabilityPolicy.BEST_EFFORT  # a console must not slow down the robot
        take = self.take_fixed if topic == FIXED else self.take_moving
        self._subscriptions[topic] = offer, self._node.create_subscription(kind, topic, take, profile)

    def take_moving(self, message: TFMessage) -> None:
        """Process a message of `/tf`."""
        self._take(message, fixed=False)

    def take_fixed(self, message: TFMessage) -> None:
        """Process a message of `/tf_static`."""
        self._take(message, fixed=True)

    def _take(self, message: TFMessage, fixed: bool) -> None:
        now, wall = self._clock(), time.time()
        for each in message.transforms:
            name, parent = each.child_frame_id.lstrip("/"), each.header.frame_id.lstrip("/")
            stamp_s = each.header.stamp.sec + each.header.stamp.nanosec * 1e-9
            seen = self._seen.get(name)
            if seen is not None and not fixed and stamp_s < seen.stamps.get(parent, -math.inf) - JUMP_BACK_S:
                self._forget_moving()
                seen = None
            if seen is None:
                if len(self._seen) >= MAX_FRAMES:
                    self._dropped += 1
                    continue
                seen = self._seen[name] = _FrameState(each, fixed, now, 0.0, since=now)
            seen.transform, seen.fixed, seen.last_received = each, fixed, now
            seen.late = wall - stamp_s
            seen.count += 1
            seen.stamps[parent] = stamp_s
            seen.parents[parent] = math.inf if fixed else now

    def _forget_moving(self) -> None:
        """Forget the moving frames from before time jumped back, as tf2 does."""
        for name in [name for name, each in self._seen.items() if not each.fixed]:
            del self._seen[name]

    def frames(self) -> Frames:
        """The frames with their latest transforms; from any thread."""
        now = self._clock()
        frames = tuple(_frame(name, each, now) for name, each in sorted(tuple(self._seen.items())))
        return Frames(frames, self._publishers[MOVING], self._publishers[FIXED], self._dropped, self._problem)


def _frame(name: str, seen: _FrameState, now: float) -> Frame:
    if now - seen.since >= WINDOW_S:
        passed, seen.since = now - seen.since, now
        seen.rate, seen.count = seen.count / passed, 0
    move, q = seen.transform.transform.translation, seen.transform.transform.rotation
    parent = seen.transform.header.frame_id.lstrip("/")
    others = (
        each
        for each, last_received in tuple(seen.parents.items())
        if each != parent and now - last_received < OTHER_PARENT_S
    )
    return Frame(
        name,
        parent,
        seen.fixed,
        (move.x, move.y, move.z),
        _angles(q.x, q.y, q.z, q.w),
        None if seen.fixed else seen.rate,
        seen.last_received,
        seen.late if not seen.fixed and abs(seen.late) < SAME_CLOCK_S else None,
        tuple(sorted(others)),
    )


def _angles(x: float, y: float, z: float, w: float) -> tuple[float, float, float]:
    """Roll, pitch and yaw (rad) of a quaternion."""
    roll = math.atan2(2.0 * (w * x + y * z), 1.0 - 2.0 * (x * x + y * y))
    pitch = math.asin(max(-1.0, min(1.0, 2.0 * (w * y - z * x))))
    return roll, pitch, math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
