"""Setting parameters all or nothing."""

import rclpy
from rcl_interfaces.msg import SetParametersResult
from rclpy.parameter import Parameter

rclpy.init()
node = rclpy.create_node("atomic")
node.declare_parameters("", [("low", 1), ("high", 5)])


def check(params):
    values = {p.name: p.value for p in params}
    low = values.get("low", node.get_parameter("low").value)
    high = values.get("high", node.get_parameter("high").value)
    return SetParametersResult(successful=low <= high, reason="" if low <= high else "low above high")


node.add_on_set_parameters_callback(check)
print(node.set_parameters_atomically([Parameter("low", value=7), Parameter("high", value=9)]))
print(node.set_parameters_atomically([Parameter("low", value=10), Parameter("high", value=9)]).reason)
print([node.get_parameter(n).value for n in ("low", "high")])
rclpy.shutdown()
