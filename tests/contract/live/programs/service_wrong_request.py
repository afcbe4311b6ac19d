"""Requests of the wrong type."""

import rclpy
from std_srvs.srv import SetBool, Trigger

rclpy.init()
node = rclpy.create_node("wrong_request")
client = node.create_client(SetBool, "s")
for wrong in (Trigger.Request(), SetBool.Response(), True, None):
    try:
        client.call_async(wrong)
    except Exception as error:
        print(type(error).__name__)
try:
    node.create_client(SetBool.Request, "s")
except Exception as error:
    print(type(error).__name__)
rclpy.shutdown()
