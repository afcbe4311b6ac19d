"""An uncaught exception in main: exit code 1."""

import rclpy

rclpy.init()
node = rclpy.create_node("main_fails")
print("before")
raise ValueError("in main")
