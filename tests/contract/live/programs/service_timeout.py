"""A client that stops waiting, and removes its request."""

import rclpy
from std_srvs.srv import Trigger

rclpy.init()
node = rclpy.create_node("impatient")
client = node.create_client(Trigger, "slow")
future = client.call_async(Trigger.Request())
rclpy.spin_until_future_complete(node, future, timeout_sec=0.1)
print(future.done(), future.result())
client.remove_pending_request(future)
print(future.cancelled())
node.destroy_client(client)
rclpy.shutdown()
