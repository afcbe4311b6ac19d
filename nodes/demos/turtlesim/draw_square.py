#!/usr/bin/env python3
"""Node `draw_square`: resets the field, then drives `turtle1` along a square of 2 m, repeatedly."""

from __future__ import annotations

import math
from collections.abc import Callable

from bot_console_demos.running import run
from geometry_msgs.msg import Twist
from rclpy.node import Node
from std_srvs.srv import Empty
from turtlesim.msg import Pose

SIDE = 2.0
"""The length of a side in m."""
SPEED, TURN_RATE = 1.0, 0.4
"""Forward speed (m/s) and turn rate (rad/s)."""
NEAR, ALIGNED, AT_REST = 0.1, 0.01, 0.0001
"""Tolerances of position (m), heading (rad) and standstill (m/s or rad/s)."""


class DrawSquare(Node):
    """Advances to the next state when a goal is reached and the turtle stands still."""

    def __init__(self) -> None:
        super().__init__("draw_square")
        self._twists = self.create_publisher(Twist, "turtle1/cmd_vel", 1)
        self._pose: Pose | None = None
        self._goal = (0.0, 0.0, 0.0)
        self._state: Callable[[Pose], None] | None = None
        self.create_subscription(Pose, "turtle1/pose", self._on_pose, 1)
        self._reset = self.create_client(Empty, "reset")
        self._reset_done = self._reset.call_async(Empty.Request())
        self.create_timer(0.016, self._tick)

    def _on_pose(self, pose: Pose) -> None:
        self._pose = pose

    def _tick(self) -> None:
        if not self._reset_done.done() or self._pose is None:
            return
        if self._state is None:
            self._go_ahead(self._pose)
        else:
            self._state(self._pose)

    def _aim(self, x: float, y: float, heading: float) -> None:
        self._goal = (x, y, heading)
        self.get_logger().info(f"New goal [{x:f} {y:f}, {heading:f}]")

    def _go_ahead(self, pose: Pose) -> None:
        self._state = self._forward
        self._aim(pose.x + math.cos(pose.theta) * SIDE, pose.y + math.sin(pose.theta) * SIDE, pose.theta)

    def _forward(self, pose: Pose) -> None:
        self._drive_until_reached(pose, SPEED, 0.0, self._stop_forward)

    def _stop_forward(self, pose: Pose) -> None:
        if self._rests(pose):
            self._state = self._turn
            self._aim(pose.x, pose.y, math.remainder(pose.theta + math.pi / 2.0, 2.0 * math.pi))

    def _turn(self, pose: Pose) -> None:
        self._drive_until_reached(pose, 0.0, TURN_RATE, self._stop_turn)

    def _stop_turn(self, pose: Pose) -> None:
        if self._rests(pose):
            self._go_ahead(pose)

    def _drive_until_reached(self, pose: Pose, speed: float, turn: float, then: Callable[[Pose], None]) -> None:
        x, y, heading = self._goal
        angle = math.remainder(pose.theta - heading, 2.0 * math.pi)
        if abs(pose.x - x) < NEAR and abs(pose.y - y) < NEAR and abs(angle) < ALIGNED:
            self._state, speed, turn = then, 0.0, 0.0
        self._drive(speed, turn)

    def _rests(self, pose: Pose) -> bool:
        if pose.angular_velocity < AT_REST and pose.linear_velocity < AT_REST:
            self.get_logger().info("Reached goal")
            return True
        self._drive(0.0, 0.0)
        return False

    def _drive(self, speed: float, turn: float) -> None:
        twist = Twist()
        twist.linear.x, twist.angular.z = speed, turn
        self._twists.publish(twist)


def main(args: list[str] | None = None) -> None:
    """Run the node."""
    run(DrawSquare, args)


if __name__ == "__main__":
    main()
