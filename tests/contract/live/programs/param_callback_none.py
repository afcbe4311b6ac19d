"""The commonest mistake: a parameter callback that returns nothing."""

import warnings

import rclpy
from rclpy.parameter import Parameter

warnings.simplefilter("ignore")
rclpy.init()
node = rclpy.create_node("forgets")
node.declare_parameter("a", 1)
node.add_on_set_parameters_callback(lambda params: None)
result = node.set_parameters([Parameter("a", value=2)])[0]
print(result.successful, node.get_parameter("a").value)
rclpy.shutdown()
