"""A service callback that forgets to return the response."""

import rclpy
from std_srvs.srv import Trigger

rclpy.init()
node = rclpy.create_node("forgetful")
node.create_service(Trigger, "t", lambda request, response: None)
client = node.create_client(Trigger, "t")
client.wait_for_service()
future = client.call_async(Trigger.Request())
try:
    rclpy.spin_until_future_complete(node, future, timeout_sec=2.0)
    print("answered", future.done())
except Exception as error:
    print(type(error).__name__)
rclpy.shutdown()
