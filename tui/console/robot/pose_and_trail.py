"""Watches the robot's surroundings: the map, its pose and speed, and the end points of its LIDAR beams.

The topics are found by type, so that a robot in a namespace, or of another make, is shown as well.
"""

from __future__ import annotations

import math
import time
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from bot_console.tui.console.model import GraphInfo
from bot_console.tui.console.offered_qos import OfferedSubscription
from bot_console.tui.console.robot.beam_ends import MAX_RANGE_M, BeamEnds
from bot_console.tui.console.robot.command_topics import NOBODY
from bot_console.tui.console.robot.fleet import Fleet, driven_robot
from bot_console.tui.console.robot.past_poses import PastPoses, heading
from bot_console.tui.console.robot.robot_model import GridMap, Pose, WorldInfo
from bot_console.tui.console.robot.turtle_watch import TurtleWatch
from nav_msgs.msg import OccupancyGrid, Odometry
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import LaserScan

MAX_TRAIL_POINTS = 400
TRAIL_STEP_M = 0.1
"""Distance between two points of the trail, in m."""
MIN_CELL_M = 1e-6
"""The smallest plausible cell size in m; the largest coordinates are limited like those of beams."""
JUMP_BACK_S = 1.0
"""How far back (s) stamps of odometry have to go to count as a jump of time: a reset, or a bag that starts again."""
SILENT_AFTER_S = 1.0
"""Seconds without a pose after which the robot counts as silent: even slow robots publish it more than once a
second.
"""

SENSOR = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
MAP, ODOMETRY = "nav_msgs/msg/OccupancyGrid", "nav_msgs/msg/Odometry"
PREFERRED: Mapping[str, tuple[str, ...]] = {
    MAP: ("map",),
    ODOMETRY: ("ground_truth", "odom"),
    "sensor_msgs/msg/LaserScan": ("scan",),
}


class WorldWatch:
    """Keeps the newest map, pose and scan; `info` combines them on demand."""

    def __init__(self, node: Node, now: Callable[[], float] = time.monotonic) -> None:
        """`now` returns seconds, to measure the robot's silence."""
        self._node = node
        self._now = now
        self._heard = 0.0
        self._subscriptions: dict[str, Any] = {}
        self._map: GridMap | None = None
        self._odometry: Odometry | None = None
        self._scan: LaserScan | None = None
        self._trail: deque[tuple[float, float]] = deque(maxlen=MAX_TRAIL_POINTS)
        self.past = PastPoses()
        self._turtles = TurtleWatch(node)
        self._fresh = False
        self._info = WorldInfo()
        self._chosen = ""
        self._robot = NOBODY
        self._shown = ""
        """The robot whose data is shown; it stays the same when the robot leaves, like its last data."""
        self._robots: tuple[str, ...] = ()
        self._fleet = Fleet(GraphInfo())

    def follow(self, graph: GraphInfo) -> None:
        """Subscribe to new topics of the chosen robot with the QoS that they offer, and drop topics that have left."""
        self._fleet = Fleet(graph)
        for each in self._subscriptions.values():
            each.follow()
        self._turtles.follow(graph)
        self._follow_robot()

    def choose(self, robot: str) -> None:
        """Watch another of `DriveInfo.robots`; to be called in the thread that serves the node."""
        self._chosen = robot
        self._follow_robot()

    def _follow_robot(self) -> None:
        before, self._robot = self._robot, driven_robot(self._fleet.robots, self._chosen)
        if self._robot.robot and self._robot.robot != self._shown:
            if self._shown:
                self._forget()
            self._shown = self._robot.robot
        scope = self._fleet.scope(self._robot)
        for type_name, wanted in PREFERRED.items():
            own = scope.own(self._fleet.published(type_name), shared=type_name == MAP)
            self._subscribe_to(type_name, best(own, wanted))
        robots = self._with_odometry()
        if (robots, self._robot.robot) != (self._robots, before.robot):
            self._robots, self._fresh = robots, True

    def _with_odometry(self) -> tuple[str, ...]:
        """The robots with odometry. Of several with the same odometry, the chosen one counts, or else the first."""
        published = self._fleet.published(ODOMETRY)
        found: dict[str, str] = {}
        for each in self._fleet.robots:
            topic = best(self._fleet.scope(each).own(published), PREFERRED[ODOMETRY])
            if topic and (topic not in found or each.robot == self._robot.robot):
                found[topic] = each.robot
        return tuple(found.values())

    def _forget(self) -> None:
        """Discard everything, so that one robot's data is not shown as another's."""
        for each in self._subscriptions.values():
            each.destroy()
        self._subscriptions.clear()
        self._map = self._odometry = self._scan = None
        self._trail.clear()
        self.past = PastPoses()

    def _subscribe_to(self, type_name: str, topic: str) -> None:
        now = self._subscriptions.get(type_name)
        if (now.topic_name if now else "") == topic:
            return
        if now:
            now.destroy()
            del self._subscriptions[type_name]
        if topic:
            kinds: dict[str, tuple[type[Any], Callable[[Any], None], QoSProfile]] = {
                MAP: (OccupancyGrid, self._on_map, LATCHED),
                ODOMETRY: (Odometry, self._on_odometry, SENSOR),
                "sensor_msgs/msg/LaserScan": (LaserScan, self._on_scan, SENSOR),
            }
            kind, callback, qos = kinds[type_name]
            self._subscriptions[type_name] = OfferedSubscription(self._node, kind, topic, callback, qos, eager=False)

    def _on_map(self, message: OccupancyGrid) -> None:
        self._map = grid_of(message)
        self._trail.clear()
        self._fresh = True

    def _on_odometry(self, message: Odometry) -> None:
        if self._odometry and _stamp_s(message) < _stamp_s(self._odometry) - JUMP_BACK_S:
            self._trail.clear()
            self._scan = None
        if pose := pose_of(message.pose.pose):
            if not self._trail or math.dist(self._trail[-1], (pose.x, pose.y)) >= TRAIL_STEP_M:
                self._trail.append((pose.x, pose.y))
            self.past.add(time.time_ns(), message.pose.pose)
        self._odometry = message
        self._heard = self._now()
        self._fresh = True

    def _on_scan(self, message: LaserScan) -> None:
        self._scan = message
        self._fresh = True

    @property
    def info(self) -> WorldInfo:
        """The robot's surroundings; the same object until something new has arrived."""
        if self._fresh or self._turtles.fresh:
            self._fresh = False
            self._info = self._build()
        silence = self._now() - self._heard if self._odometry else 0.0
        silent_s = int(silence) if silence > SILENT_AFTER_S else 0
        if silent_s != self._info.silent_s:
            self._info = replace(self._info, silent_s=silent_s)
        return self._info

    def _build(self) -> WorldInfo:
        odometry, scan = self._odometry, self._scan
        pose, speed, turn = None, 0.0, 0.0
        if odometry:
            pose = pose_of(odometry.pose.pose)
            speed, turn = odometry.twist.twist.linear.x, odometry.twist.twist.angular.z
        ends = BeamEnds(scan, pose) if scan else None
        return WorldInfo(
            self._map,
            pose,
            tuple(self._trail),
            ends or (),
            None,
            speed,
            turn,
            ends.nearest if ends is not None else None,
            self._turtles.fields(),
            robot=self._robot.robot,
            robots=self._robots,
        )


def _stamp_s(message: Odometry) -> float:
    stamp = message.header.stamp
    return stamp.sec + stamp.nanosec * 1e-9


def pose_of(message: Any) -> Pose | None:
    """A `geometry_msgs/Pose` in the plane; None if it cannot be drawn."""
    place = message.position
    inside = abs(place.x) <= MAX_RANGE_M and abs(place.y) <= MAX_RANGE_M  # False for NaN
    return Pose(place.x, place.y, heading(message.orientation)) if inside else None


def grid_of(message: OccupancyGrid) -> GridMap | None:
    """Convert a map to the console's form; None if its size, position or number of cells is invalid."""
    meta = message.info
    origin = pose_of(meta.origin)
    count = meta.width * meta.height
    if origin is None or not count or count != len(message.data):
        return None
    if not (meta.resolution >= MIN_CELL_M and max(meta.width, meta.height) * meta.resolution <= MAX_RANGE_M):
        return None
    cells = np.asarray(message.data, np.int8).tobytes()  # -1, unknown, becomes the byte 255
    return GridMap(meta.width, meta.height, meta.resolution, origin, cells)


def best(offered: set[str], wanted: tuple[str, ...]) -> str:
    """The offered topic whose last token comes first in `wanted`, or else the first by length and name."""
    ranked = sorted(offered, key=lambda name: (_rank(name.rsplit("/", 1)[-1], wanted), len(name), name))
    return ranked[0] if ranked else ""


def _rank(token: str, wanted: tuple[str, ...]) -> int:
    return wanted.index(token) if token in wanted else len(wanted)
