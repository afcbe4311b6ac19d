"""A raw subscription gets bytes, which deserialize to the message."""

import rclpy
from rclpy.serialization import deserialize_message, serialize_message
from std_msgs.msg import String

rclpy.init()
node = rclpy.create_node("raw")
got = []
node.create_subscription(String, "t", got.append, 10, raw=True)
publisher = node.create_publisher(String, "t", 10)
while not publisher.get_subscription_count():
    rclpy.spin_once(node, timeout_sec=0.01)
publisher.publish(String(data="abc"))
publisher.publish(serialize_message(String(data="raw")))
while len(got) < 2:
    rclpy.spin_once(node, timeout_sec=0.1)
print([deserialize_message(each, String).data for each in got], got[0])
rclpy.shutdown()
