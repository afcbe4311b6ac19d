"""What the navigator knows: the map, the robot's pose, and the free room around it."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt
from bot_console_robot.common.scans import SCANS, ranges_of
from bot_console_robot.navigation.goal_motion import Observation
from bot_console_robot.navigation.path_following import Limits, Point, Pose
from bot_console_robot.navigation.planner import Grid, NoPath, Planner
from bot_console_robot.simulation_ros.messages import heading_of
from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import OccupancyGrid, Odometry
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import LaserScan

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
CLEARANCE_M = 0.05
"""Distance in m to keep between the hull and obstacles, on paths and ahead."""
CORRIDOR_M = 0.25
"""Half the width (m) of the area checked ahead and behind."""
SCAN_TIMEOUT_S = 1.0
"""Seconds after which a scan is outdated and the robot stands still."""


class WorldModel:
    """Subscribes to the sensors on behalf of a node.

    The pose is `ground_truth` if available, else odometry; it is republished as `amcl_pose`.
    """

    def __init__(self, node: Node, seconds: Callable[[], float]) -> None:
        self._node = node
        self._seconds = seconds
        self._planner: Planner | None = None
        self.pose: Pose | None = None
        self._true = False
        self._scan: tuple[float, float, float] | None = None
        node.create_subscription(OccupancyGrid, "map", self._on_map, LATCHED)
        node.create_subscription(Odometry, "ground_truth", self._on_truth, 10)
        node.create_subscription(Odometry, "odom", self._on_odometry, 10)
        node.create_subscription(LaserScan, "scan", self._on_scan, SCANS)
        self._reported = node.create_publisher(PoseWithCovarianceStamped, "amcl_pose", LATCHED)

    def _on_map(self, message: OccupancyGrid) -> None:
        meta = message.info
        flat: Any = np.array(message.data, np.int8)
        cells: npt.NDArray[np.int8] = flat.reshape(meta.height, meta.width)
        clearance = float(self._node.get_parameter("robot_radius").value) + CLEARANCE_M
        origin = meta.origin.position.x, meta.origin.position.y
        self._planner = Planner(Grid(cells, meta.resolution, origin), clearance)

    def _on_truth(self, message: Odometry) -> None:
        self._true = True
        self._take(message)

    def _on_odometry(self, message: Odometry) -> None:
        if not self._true:
            self._take(message)

    def _take(self, message: Odometry) -> None:
        place = message.pose.pose
        pose = place.position.x, place.position.y, heading_of(place.orientation)
        if not all(map(math.isfinite, pose)):
            return
        self.pose = pose
        if self._reported.get_subscription_count():
            reported = PoseWithCovarianceStamped()
            reported.header.stamp, reported.header.frame_id = message.header.stamp, "map"
            reported.pose.pose = place
            self._reported.publish(reported)

    def _on_scan(self, scan: LaserScan) -> None:
        ranges = ranges_of(scan)
        angles = scan.angle_min + scan.angle_increment * np.arange(len(ranges))
        usable = np.isfinite(ranges)
        along, aside = ranges[usable] * np.cos(angles[usable]), ranges[usable] * np.sin(angles[usable])
        inside = np.abs(aside) < CORRIDOR_M
        ahead = float(np.min(along[inside & (along > 0)], initial=math.inf))
        behind = float(np.min(-along[inside & (along < 0)], initial=math.inf))
        self._scan = self._seconds(), ahead, behind

    def observation(self) -> Observation | None:
        """Return the current state, or None if there is no pose. Without a recent scan, it has no free room on either
        side.
        """
        if self.pose is None:
            return None
        now = self._seconds()
        fresh = self._scan is not None and now - self._scan[0] < SCAN_TIMEOUT_S
        ahead, behind = self._scan[1:] if self._scan is not None and fresh else (0.0, 0.0)
        return Observation(now, self.pose, ahead, behind)

    def plan(self, start: Point, goal: Point) -> list[Point]:
        """Return a path on the map, or a straight line if there is no map. Raises `NoPath`."""
        if self._planner is None:
            if not all(map(math.isfinite, goal)):
                raise NoPath("a position is not a finite number")
            return [goal]
        return self._planner.plan(start, goal)

    def limits(self) -> Limits:
        """Return speeds and tolerances from the current parameters."""

        def value(name: str) -> float:
            return float(self._node.get_parameter(name).value)

        return Limits(
            value("max_speed"), value("max_turn_rate"), value("xy_goal_tolerance"), value("yaw_goal_tolerance"),
            value("robot_radius") + CLEARANCE_M,
        )  # fmt: skip
