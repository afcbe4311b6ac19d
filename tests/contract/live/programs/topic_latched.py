"""A latched topic reaches a late subscription."""

import rclpy
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String

rclpy.init()
node = rclpy.create_node("latched")
qos = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
publisher = node.create_publisher(String, "map_name", qos)
publisher.publish(String(data="old"))
publisher.publish(String(data="office"))
got = []
node.create_subscription(String, "map_name", lambda m: got.append(m.data), qos)
while not got:
    rclpy.spin_once(node, timeout_sec=0.1)
rclpy.spin_once(node, timeout_sec=0.1)
print(got)
rclpy.shutdown()
