"""Entities as context managers."""

import rclpy
from std_msgs.msg import String
from std_srvs.srv import Empty

rclpy.init()
node = rclpy.create_node("managed")
with (
    node.create_publisher(String, "t", 1) as publisher,
    node.create_subscription(String, "t", print, 1) as subscription,
):
    print(publisher.topic_name, subscription.topic_name)
with node.create_service(Empty, "s", print) as service, node.create_client(Empty, "s") as client:
    print(service.srv_name, client.srv_name)
rclpy.shutdown()
