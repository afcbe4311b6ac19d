"""An exception in a service callback leaves spin."""

import rclpy
from std_srvs.srv import Trigger

rclpy.init()
node = rclpy.create_node("failing")


def fail(request, response):
    raise ValueError("no fuel")


node.create_service(Trigger, "t", fail)
client = node.create_client(Trigger, "t")
client.wait_for_service()
client.call_async(Trigger.Request())
try:
    rclpy.spin(node)
except ValueError as error:
    print("caught", error)
rclpy.shutdown()
