"""Parameters from arguments override the defaults."""

import rclpy

words = ["--ros-args", "-p", "speed:=2.5", "-p", "names:=[a, b]", "-p", "other:on:=true", "-p", "count:=3"]
rclpy.init(args=words)
node = rclpy.create_node("n")
for name, default in (("speed", 1.0), ("names", ["x"]), ("on", False), ("count", 1)):
    print(name, node.declare_parameter(name, default).value)
try:
    node.declare_parameter("late", 1)
    print(node.get_parameter("late").value)
except Exception as error:
    print(type(error).__name__)
rclpy.shutdown()
