"""An exception in a timer ends the program with a traceback."""

import rclpy

rclpy.init()
node = rclpy.create_node("crash")


def tick():
    raise RuntimeError("motor stalled")


node.create_timer(0.001, tick)
rclpy.spin(node)
