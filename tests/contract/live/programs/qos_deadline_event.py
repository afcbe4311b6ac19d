"""A missed deadline calls the event callback."""

import rclpy
from rclpy.duration import Duration
from rclpy.event_handler import PublisherEventCallbacks
from rclpy.qos import QoSProfile
from std_msgs.msg import String

rclpy.init()
node = rclpy.create_node("deadline")
missed = []
qos = QoSProfile(depth=1, deadline=Duration(seconds=0.05))
publisher = node.create_publisher(String, "t", qos, event_callbacks=PublisherEventCallbacks(deadline=missed.append))
publisher.publish(String(data="once"))
while not missed:
    rclpy.spin_once(node, timeout_sec=1)
print(missed[0].total_count >= 1, type(missed[0]).__name__)
rclpy.shutdown()
