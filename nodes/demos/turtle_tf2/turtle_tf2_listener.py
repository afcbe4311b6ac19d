"""Node `turtle_tf2_frame_listener`: spawns `turtle2` and steers it to the frame `target_frame`."""

from __future__ import annotations

import math
from typing import Any

from bot_console_demos.running import run
from geometry_msgs.msg import Twist
from rclpy.node import Node
from rclpy.time import Time
from tf2_ros import Buffer, TransformException, TransformListener
from turtlesim.srv import Spawn

FOLLOWER = "turtle2"
ROTATION_RATE, FORWARD_SPEED = 1.0, 0.5
"""Gains from angle to turn rate (1/s), and from distance to speed (1/s)."""


class FrameListener(Node):
    """Looks up the target relative to the follower once a second, and drives there."""

    def __init__(self) -> None:
        super().__init__("turtle_tf2_frame_listener")
        self._target = str(self.declare_parameter("target_frame", "turtle1").value)
        self._buffer = Buffer()
        self._listener = TransformListener(self._buffer, self)
        self._spawner = self.create_client(Spawn, "spawn")
        self._asked: Any = None
        self._spawned = False
        self._twists = self.create_publisher(Twist, f"{FOLLOWER}/cmd_vel", 1)
        self.create_timer(1.0, self._tick)

    def _tick(self) -> None:
        if self._spawned:
            self._follow()
        elif self._asked is not None:
            self._spawned = self._asked.done()
            name = self._asked.result().name if self._spawned else ""
            self.get_logger().info(f"Successfully spawned {name}" if name else "Spawn is not finished")
        elif self._spawner.service_is_ready():
            self._asked = self._spawner.call_async(Spawn.Request(name=FOLLOWER, x=4.0, y=2.0, theta=0.0))
        else:
            self.get_logger().info("Service is not ready")

    def _follow(self) -> None:
        try:
            where = self._buffer.lookup_transform(FOLLOWER, self._target, Time()).transform.translation
        except TransformException as error:
            self.get_logger().info(f"Could not transform {FOLLOWER} to {self._target}: {error}")
            return
        twist = Twist()
        twist.angular.z = ROTATION_RATE * math.atan2(where.y, where.x)
        twist.linear.x = FORWARD_SPEED * math.hypot(where.x, where.y)
        self._twists.publish(twist)


def main(args: list[str] | None = None) -> None:
    """Run the node."""
    run(FrameListener, args)
