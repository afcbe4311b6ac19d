"""A client without a server."""

import rclpy
from rclpy.action import ActionClient

try:
    from example_interfaces.action import Fibonacci
except ImportError:  # PyPI has another package with the same action
    from test_msgs.action import Fibonacci

rclpy.init()
node = rclpy.create_node("alone")
client = ActionClient(node, Fibonacci, "nobody")
print(client.wait_for_server(timeout_sec=0.1), client.server_is_ready())
try:
    client.send_goal_async(5)
except Exception as error:
    print(type(error).__name__)
client.destroy()
node.destroy_node()
rclpy.shutdown()
