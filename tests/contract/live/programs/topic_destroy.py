"""Destroying a subscription, a publisher and a node."""

import rclpy
from std_msgs.msg import String

rclpy.init()
node = rclpy.create_node("destroyer")
subscription = node.create_subscription(String, "t", print, 10)
publisher = node.create_publisher(String, "t", 10)
print(node.destroy_subscription(subscription), node.destroy_subscription(subscription))
print(node.destroy_publisher(publisher), node.destroy_publisher(publisher))
try:
    publisher.publish(String())
except Exception as error:
    print(type(error).__name__, error)
print(len(list(node.subscriptions)), len(list(node.publishers)))
node.destroy_node()
try:
    node.create_publisher(String, "x", 1)
except Exception as error:
    print(type(error).__name__, error)
rclpy.shutdown()
