"""Descriptors with ranges and read-only."""

import rclpy
from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor
from rclpy.parameter import Parameter

rclpy.init()
node = rclpy.create_node("ranges")
speed = ParameterDescriptor(
    description="m/s", floating_point_range=[FloatingPointRange(from_value=0.0, to_value=2.0, step=0.5)]
)
count = ParameterDescriptor(integer_range=[IntegerRange(from_value=1, to_value=9, step=2)])
node.declare_parameter("speed", 1.0, speed)
node.declare_parameter("count", 3, count)
node.declare_parameter("serial", "A1", ParameterDescriptor(read_only=True))
for name, value in (("speed", 1.5), ("speed", 1.7), ("speed", 3.0), ("count", 5), ("count", 4), ("serial", "B2")):
    result = node.set_parameters([Parameter(name, value=value)])[0]
    print(name, value, result.successful, result.reason)
print(node.describe_parameter("speed").description)
try:
    node.declare_parameter("bad", 7.0, speed)
except Exception as error:
    print(type(error).__name__, error)
rclpy.shutdown()
