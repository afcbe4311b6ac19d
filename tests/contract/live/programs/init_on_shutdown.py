"""Callbacks at the shutdown of the context."""

import rclpy

rclpy.init()
context = rclpy.get_default_context()
context.on_shutdown(lambda: print("first"))
context.on_shutdown(lambda: print("second"))
rclpy.shutdown()
print("end", context.ok())
