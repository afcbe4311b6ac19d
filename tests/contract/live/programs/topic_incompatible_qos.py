"""A best effort publisher and a reliable subscription: the default handlers warn."""

import time

import rclpy
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import String

rclpy.init()
node = rclpy.create_node("mismatch")
best = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
publisher = node.create_publisher(String, "t", best)
got = []
node.create_subscription(String, "t", got.append, QoSProfile(depth=1, reliability=ReliabilityPolicy.RELIABLE))
end = time.time() + 0.5
while time.time() < end:
    publisher.publish(String(data="x"))
    rclpy.spin_once(node, timeout_sec=0.05)
print(len(got), publisher.get_subscription_count())
rclpy.shutdown()
