#!/usr/bin/env python3
"""Node `turtle_mimic`: makes one turtle imitate another. Remap `input/pose` and `output/cmd_vel`."""

from __future__ import annotations

from bot_console_demos.running import run
from geometry_msgs.msg import Twist
from rclpy.node import Node
from turtlesim.msg import Pose


class Mimic(Node):
    """Converts the pose of one turtle to the velocity of another."""

    def __init__(self) -> None:
        super().__init__("turtle_mimic")
        self._twists = self.create_publisher(Twist, "output/cmd_vel", 1)
        self.create_subscription(Pose, "input/pose", self._on_pose, 1)

    def _on_pose(self, pose: Pose) -> None:
        twist = Twist()
        twist.linear.x = pose.linear_velocity
        twist.angular.z = pose.angular_velocity
        self._twists.publish(twist)


def main(args: list[str] | None = None) -> None:
    """Run the node."""
    run(Mimic, args)


if __name__ == "__main__":
    main()
