import rclpy
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor

rclpy.init()
node = rclpy.create_node("robot")
limits = ParameterDescriptor(floating_point_range=[FloatingPointRange(from_value=0.0, to_value=5.0)])
node.declare_parameter("speed", 1.0, limits)
rclpy.spin(node)
