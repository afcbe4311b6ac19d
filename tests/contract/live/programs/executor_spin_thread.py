"""Spinning in a thread, and shutting down from the main one."""

import threading
import time

import rclpy
from rclpy.executors import ExternalShutdownException
from std_msgs.msg import Int32

rclpy.init()
node = rclpy.create_node("background")
got = []
node.create_subscription(Int32, "t", lambda m: got.append(m.data), 10)
publisher = node.create_publisher(Int32, "t", 10)


def spin():
    try:
        rclpy.spin(node)
        print("spin returned")
    except ExternalShutdownException:
        print("external shutdown")


thread = threading.Thread(target=spin)
thread.start()
while not publisher.get_subscription_count():
    time.sleep(0.01)
for number in range(3):
    publisher.publish(Int32(data=number))
while len(got) < 3:
    time.sleep(0.01)
print(got)
rclpy.shutdown()
thread.join(timeout=5)
print(thread.is_alive())
