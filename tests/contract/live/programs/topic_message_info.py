"""A callback with message info."""

import rclpy
from std_msgs.msg import Int32

rclpy.init()
node = rclpy.create_node("info")
seen = []


def callback(message, info):
    seen.append((message.data, sorted(info), info["source_timestamp"] > 0))


node.create_subscription(Int32, "t", callback, 10)
publisher = node.create_publisher(Int32, "t", 10)
while not publisher.get_subscription_count():
    rclpy.spin_once(node, timeout_sec=0.01)
publisher.publish(Int32(data=7))
while not seen:
    rclpy.spin_once(node, timeout_sec=0.1)
print(seen)
rclpy.shutdown()
