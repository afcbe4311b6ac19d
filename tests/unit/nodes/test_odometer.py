"""Odometry messages of the simulator: one message object that is reused."""

from __future__ import annotations

import math

from bot_console_robot.simulation.geometry import Pose
from bot_console_robot.simulation_ros.messages import Odometer, heading_of, time_of


def test_reused_message_contains_only_the_latest_report() -> None:
    odometer = Odometer("odom", "base_footprint")
    odometer.report(Pose(1.0, 2.0, 3.0), (0.5, -0.25), time_of(1))
    message = odometer.report(Pose(-4.0, 5.0, -0.5 * math.pi), (-1.0, 0.75), time_of(7_000_000_009))
    assert (message.header.frame_id, message.child_frame_id) == ("odom", "base_footprint")
    assert (message.header.stamp.sec, message.header.stamp.nanosec) == (7, 9)
    place, motion = message.pose.pose, message.twist.twist
    assert (place.position.x, place.position.y) == (-4.0, 5.0)
    assert math.isclose(heading_of(place.orientation), -0.5 * math.pi)
    assert (motion.linear.x, motion.angular.z) == (-1.0, 0.75)
