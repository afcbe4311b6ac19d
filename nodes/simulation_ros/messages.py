"""Converts the state of the simulation to ROS messages. Of the frames, `map` is the truth, and `odom` drifts."""

from __future__ import annotations

import math
from array import array
from collections.abc import Iterable

import numpy as np
from bot_console_robot.common.scans import packed
from bot_console_robot.simulation.arrays import Floats
from bot_console_robot.simulation.geometry import Point, Pose
from bot_console_robot.simulation.lidar import LidarSettings, Scan
from bot_console_robot.simulation.occupancy import occupancy_grid
from bot_console_robot.simulation.world import World
from bot_console_robot.simulation_ros.models import Model
from builtin_interfaces.msg import Time
from geometry_msgs.msg import PoseStamped, Quaternion
from nav_msgs.msg import OccupancyGrid, Odometry, Path
from sensor_msgs.msg import LaserScan
from visualization_msgs.msg import Marker, MarkerArray

MAP, ODOM = "map", "odom"
FULL_TURN = 6.2
"""Fields of view of at least this angle (rad) count as a full turn."""
PERSON_HEIGHT_M = 1.7


def time_of(nanoseconds: int) -> Time:
    """A time stamp."""
    seconds, rest = divmod(nanoseconds, 1_000_000_000)
    return Time(sec=seconds, nanosec=rest)


def quaternion(heading: float) -> Quaternion:
    """The orientation of a heading in rad."""
    return Quaternion(x=0.0, y=0.0, z=math.sin(0.5 * heading), w=math.cos(0.5 * heading))


def heading_of(q: Quaternion) -> float:
    """The heading in rad of an orientation."""
    return math.atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))


def scan_message(scan: Scan, settings: LidarSettings, period: float, stamp: Time, model: Model) -> LaserScan:
    """A scan, taken `period` s after the one before."""
    first, ranges, intensities = settings.first_angle, scan.ranges, scan.intensities
    if model.scan_from_front and settings.field_of_view > FULL_TURN:
        ahead = settings.beams // 2
        first, ranges, intensities = 0.0, np.roll(ranges, -ahead), np.roll(intensities, -ahead)
    message = LaserScan()
    message.header.stamp = stamp
    message.header.frame_id = model.scan
    message.angle_min = first
    message.angle_max = first + settings.field_of_view
    message.angle_increment = settings.increment
    message.scan_time = period
    message.range_min = settings.range_min
    message.range_max = settings.range_max
    message.ranges = packed(ranges)
    message.intensities = packed(intensities)
    return message


class Odometer:
    """Makes odometry messages, with a pose in the first of two frames and a velocity in the second, the robot's own.

    It reuses one message: publishing copies it, and creating a new one would cost more.
    """

    def __init__(self, frame: str, child_frame: str) -> None:
        self._message = message = Odometry(child_frame_id=child_frame)
        self._header, place, motion = message.header, message.pose.pose, message.twist.twist
        self._header.frame_id = frame
        self._position, self._orientation = place.position, place.orientation
        self._linear, self._angular = motion.linear, motion.angular

    def report(self, pose: Pose, velocity: tuple[float, float], stamp: Time) -> Odometry:
        """Return the message, to be published before the next call; `velocity` is in m/s, rad/s."""
        x, y, heading = pose
        self._header.stamp = stamp
        self._position.x, self._position.y = x, y
        self._orientation.z, self._orientation.w = math.sin(0.5 * heading), math.cos(0.5 * heading)
        self._linear.x, self._angular.z = velocity
        return self._message


def map_message(world: World, corner: Pose, resolution: float, stamp: Time) -> OccupancyGrid:
    """The static obstacles as a grid with cells of `resolution` m; `corner` is the world's origin in the map."""
    grid = occupancy_grid(world, resolution)
    message = OccupancyGrid()
    message.header.stamp = stamp
    message.header.frame_id = MAP
    message.info.map_load_time = stamp
    message.info.resolution = resolution
    message.info.height, message.info.width = grid.shape
    message.info.origin.position.x, message.info.origin.position.y = corner.x, corner.y
    cells = array("b")
    cells.frombytes(grid.tobytes())
    message.data = cells
    return message


def route_message(points: Iterable[Point], stamp: Time) -> Path:
    """Waypoints (m) in the map."""
    message = Path()
    message.header.stamp = stamp
    message.header.frame_id = MAP
    poses: list[PoseStamped] = []
    for x, y in points:
        pose = PoseStamped(header=message.header)
        pose.pose.position.x, pose.pose.position.y = x, y
        poses.append(pose)
    message.poses = poses
    return message


def obstacles_message(moving: Floats, stamp: Time) -> MarkerArray:
    """Moving obstacles, rows of x, y, radius in m, as upright cylinders."""
    return MarkerArray(markers=[_cylinder(i, row, stamp) for i, row in enumerate(moving)])


def _cylinder(number: int, row: Floats, stamp: Time) -> Marker:
    x, y, radius = (float(each) for each in row)
    marker = Marker(ns="moving", id=number, type=Marker.CYLINDER, action=Marker.ADD)
    marker.header.stamp = stamp
    marker.header.frame_id = MAP
    marker.pose.position.x, marker.pose.position.y, marker.pose.position.z = x, y, 0.5 * PERSON_HEIGHT_M
    marker.scale.x = marker.scale.y = 2.0 * radius
    marker.scale.z = PERSON_HEIGHT_M
    marker.color.r, marker.color.g, marker.color.b, marker.color.a = 0.9, 0.6, 0.1, 1.0
    return marker
