"""Publication and subscription matched events."""

import rclpy
from rclpy.event_handler import PublisherEventCallbacks
from std_msgs.msg import String

rclpy.init()
node = rclpy.create_node("matched")
events = []
callbacks = PublisherEventCallbacks(matched=lambda info: events.append((info.current_count, info.current_count_change)))
node.create_publisher(String, "t", 10, event_callbacks=callbacks)
subscription = node.create_subscription(String, "t", print, 10)
while len(events) < 1:
    rclpy.spin_once(node, timeout_sec=0.1)
node.destroy_subscription(subscription)
while len(events) < 2:
    rclpy.spin_once(node, timeout_sec=0.1)
print(events)
rclpy.shutdown()
