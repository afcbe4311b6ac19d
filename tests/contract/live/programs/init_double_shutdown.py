"""A second shutdown raises."""

import rclpy

rclpy.init()
node = rclpy.create_node("n")
node.destroy_node()
rclpy.shutdown()
rclpy.shutdown()
