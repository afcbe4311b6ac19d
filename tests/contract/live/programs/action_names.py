"""Actions in the graph."""

import time

import rclpy
from rclpy.action import ActionServer, get_action_names_and_types

try:
    from example_interfaces.action import Fibonacci
except ImportError:  # PyPI has another package with the same action
    from test_msgs.action import Fibonacci

rclpy.init()
node = rclpy.create_node("names", namespace="/ns")
server = ActionServer(node, Fibonacci, "~/count", lambda handle: Fibonacci.Result())
end = time.time() + 1
while not get_action_names_and_types(node) and time.time() < end:
    time.sleep(0.01)
print([name for name, _ in get_action_names_and_types(node)])
print([name for name, _ in node.get_service_names_and_types_by_node("names", "/ns") if "count" in name])
rclpy.shutdown()
