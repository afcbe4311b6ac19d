import sys

import rclpy
from rclpy.qos import QoSDurabilityPolicy, QoSProfile, QoSReliabilityPolicy
from std_msgs.msg import String

rclpy.init()
policies = {
    "reliable": QoSReliabilityPolicy.RELIABLE,
    "best_effort": QoSReliabilityPolicy.BEST_EFFORT,
    "volatile": QoSDurabilityPolicy.VOLATILE,
    "transient_local": QoSDurabilityPolicy.TRANSIENT_LOCAL,
}
role, reliability, durability = sys.argv[1:4]
qos = QoSProfile(depth=3, reliability=policies[reliability], durability=policies[durability])
node = rclpy.create_node(role)
if role == "talker":
    publisher = node.create_publisher(String, "map", qos)
    for number in range(5):
        publisher.publish(String(data=f"map {number}"))
else:
    node.create_subscription(String, "map", lambda msg: node.get_logger().info(msg.data), qos)
rclpy.spin(node)
