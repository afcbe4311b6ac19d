"""Reading, setting and declaring parameters that are not declared, or already are."""

import rclpy
from rclpy.parameter import Parameter

rclpy.init()
node = rclpy.create_node("undeclared")
for call in (
    lambda: node.get_parameter("nope"),
    lambda: node.set_parameters([Parameter("nope", value=1)]),
    lambda: node.declare_parameter("a", 1) and node.declare_parameter("a", 1),
    lambda: node.undeclare_parameter("nope"),
    lambda: node.declare_parameter("", 1),
    lambda: node.declare_parameter("untyped"),
):
    try:
        print(call())
    except Exception as error:
        print(type(error).__name__, error)
print(node.get_parameter_or("nope", Parameter("x", value=5)).value, node.has_parameter("a"))
rclpy.shutdown()
