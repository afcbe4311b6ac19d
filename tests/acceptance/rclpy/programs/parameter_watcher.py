import rclpy
from rclpy.parameter_event_handler import ParameterEventHandler

rclpy.init()
node = rclpy.create_node("node_with_parameters")
node.declare_parameter("an_int_param", 0)
handler = ParameterEventHandler(node)


def own(parameter):
    node.get_logger().info(f"Received an update to parameter: {parameter.name}: {parameter.value.integer_value}")


def remote(parameter):
    node.get_logger().info(f"Received an update to remote parameter: {parameter.value.double_value}")


kept = [
    handler.add_parameter_callback(parameter_name="an_int_param", node_name="node_with_parameters", callback=own),
    handler.add_parameter_callback(parameter_name="speed", node_name="/robot", callback=remote),
]
rclpy.spin(node)
