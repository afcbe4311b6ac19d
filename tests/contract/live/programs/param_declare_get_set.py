"""Declare, get, set parameters, with a callback that refuses."""

import rclpy
from rcl_interfaces.msg import SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter


class Robot(Node):
    def __init__(self):
        super().__init__("robot")
        self.declare_parameter("max_speed", 1.5)
        self.declare_parameter("name", "bob")
        self.add_on_set_parameters_callback(self.check)

    def check(self, params):
        for param in params:
            if param.name == "max_speed" and param.value < 0.0:
                return SetParametersResult(successful=False, reason="max_speed cannot be negative")
        self.get_logger().info(", ".join(f"{p.name}={p.value}" for p in params))
        return SetParametersResult(successful=True)


rclpy.init()
node = Robot()
print(node.get_parameter("max_speed").value, node.get_parameter("name").get_parameter_value().string_value)
for value in (2.0, -1.0, 3, "fast"):
    result = node.set_parameters([Parameter("max_speed", value=value)])[0]
    print(result.successful, result.reason)
print(node.get_parameter("max_speed").value)
rclpy.shutdown()
