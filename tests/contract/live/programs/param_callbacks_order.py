"""Pre-set, on-set and post-set callbacks, in their order."""

import rclpy
from rcl_interfaces.msg import SetParametersResult
from rclpy.parameter import Parameter

rclpy.init()
node = rclpy.create_node("order")
node.declare_parameters("", [("a", 1), ("b", 2)])
log = []


def pre(params):
    log.append("pre " + ",".join(p.name for p in params))
    return [*params, Parameter("b", value=20)]


def on(name):
    def check(params):
        log.append(f"{name} " + ",".join(p.name for p in params))
        return SetParametersResult(successful=True)

    return check


node.add_pre_set_parameters_callback(pre)
node.add_on_set_parameters_callback(on("first"))
node.add_on_set_parameters_callback(on("second"))
node.add_post_set_parameters_callback(lambda params: log.append("post " + ",".join(p.name for p in params)))
print(node.set_parameters([Parameter("a", value=10)]))
print(log, node.get_parameter("b").value)
rclpy.shutdown()
