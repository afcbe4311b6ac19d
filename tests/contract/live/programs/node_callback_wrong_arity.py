"""Callbacks with the wrong number of parameters."""

import rclpy
from std_msgs.msg import String
from std_srvs.srv import Trigger

rclpy.init()
node = rclpy.create_node("arity")
for call in (
    lambda: node.create_subscription(String, "t", lambda: None, 10),
    lambda: node.create_subscription(String, "t", lambda a, b, c: None, 10),
    lambda: node.create_subscription(String, "t", None, 10),
    lambda: node.create_timer("1", print),
    lambda: node.create_publisher("String", "t", 10),
    lambda: node.create_publisher(String, "t", "ten"),
    lambda: node.create_publisher(String, "t"),
    lambda: node.create_service(String, "s", print),
    lambda: node.create_client(Trigger, 5),
):
    try:
        print(type(call()).__name__)
    except Exception as error:
        print(type(error).__name__)
rclpy.shutdown()
