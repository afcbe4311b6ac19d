"""A node with many topics: `busy_topics.py TOPICS FAST`; the first `FAST` go at 100 Hz, the others at 1 Hz."""

from __future__ import annotations

import contextlib
import sys

import rclpy
from geometry_msgs.msg import PoseStamped
from rclpy.executors import ExternalShutdownException


def main() -> None:
    topics, fast = int(sys.argv[1]), int(sys.argv[2])
    rclpy.init()
    node = rclpy.create_node("busy")
    names = [f"/busy/t{number:03}" for number in range(topics)]
    publishers = [node.create_publisher(PoseStamped, name, 10) for name in names]
    message = PoseStamped()

    def send(those: list[object]) -> None:
        message.header.stamp = node.get_clock().now().to_msg()
        for each in those:
            each.publish(message)

    node.create_timer(0.01, lambda: send(publishers[:fast]))
    node.create_timer(1.0, lambda: send(publishers[fast:]))
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException):
        rclpy.spin(node)


if __name__ == "__main__":
    main()
