"""An override of a different type makes the declaration fail."""

import rclpy

rclpy.init(args=["--ros-args", "-p", "speed:=fast"])
node = rclpy.create_node("n")
try:
    node.declare_parameter("speed", 1.0)
except Exception as error:
    print(type(error).__name__, error)
rclpy.shutdown()
