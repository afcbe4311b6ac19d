"""sys.exit in a callback."""

import sys

import rclpy

rclpy.init()
node = rclpy.create_node("leaver")
node.create_timer(0.001, lambda: sys.exit(5))
rclpy.spin(node)
