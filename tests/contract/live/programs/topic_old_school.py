"""A program without a class: a loop around spin_once."""

import rclpy
from std_msgs.msg import Int32

rclpy.init()
node = rclpy.create_node("old_school")
publisher = node.create_publisher(Int32, "numbers", 10)
heard = []
subscription = node.create_subscription(Int32, "numbers", lambda m: heard.append(m.data), 10)
while publisher.get_subscription_count() == 0:
    rclpy.spin_once(node, timeout_sec=0.01)
for number in range(5):
    publisher.publish(Int32(data=number))
while len(heard) < 5:
    rclpy.spin_once(node, timeout_sec=0.1)
print(heard)
node.destroy_node()
rclpy.shutdown()
