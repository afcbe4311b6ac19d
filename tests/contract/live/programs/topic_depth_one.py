"""With depth 1 only the newest message is queued."""

import time

import rclpy
from std_msgs.msg import Int32

rclpy.init()
node = rclpy.create_node("depth")
got = []
node.create_subscription(Int32, "t", lambda m: got.append(m.data), 1)
publisher = node.create_publisher(Int32, "t", 10)
while not publisher.get_subscription_count():
    time.sleep(0.01)
for number in range(10):
    publisher.publish(Int32(data=number))
time.sleep(0.2)
for _ in range(5):
    rclpy.spin_once(node, timeout_sec=0.05)
print(got)
rclpy.shutdown()
