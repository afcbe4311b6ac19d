"""A client without a server gives up."""

import sys

import rclpy
from std_srvs.srv import Empty

rclpy.init()
node = rclpy.create_node("lonely")
client = node.create_client(Empty, "nobody_serves_this")
for _ in range(2):
    if not client.wait_for_service(timeout_sec=0.05):
        node.get_logger().warn("service not available, waiting again...")
print(client.service_is_ready(), client.srv_name)
node.destroy_node()
rclpy.shutdown()
sys.exit(3)
