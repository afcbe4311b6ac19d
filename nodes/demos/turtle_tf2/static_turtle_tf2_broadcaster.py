"""Node `static_turtle_tf2_broadcaster`: a static frame in `world`, placed by the command line."""

from __future__ import annotations

import sys
from functools import partial

from bot_console_demos.running import run
from bot_console_demos.turtle_tf2.frames import quaternion
from geometry_msgs.msg import TransformStamped
from rclpy.logging import get_logger
from rclpy.node import Node
from rclpy.utilities import remove_ros_args
from tf2_ros import StaticTransformBroadcaster

USAGE = """Invalid number of parameters. Usage:
$ ros2 run turtle_tf2_py static_turtle_tf2_broadcaster child_frame_name x y z roll pitch yaw"""


class StaticFramePublisher(Node):
    """Broadcasts once; late subscribers receive it as well."""

    def __init__(self, child: str, x: float, y: float, z: float, roll: float, pitch: float, yaw: float) -> None:
        super().__init__("static_turtle_tf2_broadcaster")
        frame = TransformStamped(child_frame_id=child)
        frame.header.stamp = self.get_clock().now().to_msg()
        frame.header.frame_id = "world"
        move = frame.transform.translation
        move.x, move.y, move.z = x, y, z
        frame.transform.rotation = quaternion(roll, pitch, yaw)
        self._broadcaster = StaticTransformBroadcaster(self)
        self._broadcaster.sendTransform(frame)


def main(args: list[str] | None = None) -> None:
    """Run the node with the arguments of the command line."""
    words = remove_ros_args(args)[1:]
    logger = get_logger("rclpy")
    try:
        child, (x, y, z, roll, pitch, yaw) = words[0], map(float, words[1:])
    except (IndexError, ValueError):
        logger.info(USAGE)
        sys.exit(1)
    if child == "world":
        logger.info('Your static turtle name cannot be "world"')
        sys.exit(2)
    run(partial(StaticFramePublisher, child, x, y, z, roll, pitch, yaw), args)
