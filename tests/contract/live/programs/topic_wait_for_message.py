"""wait_for_message, with and without a message."""

import threading

import rclpy
from rclpy.wait_for_message import wait_for_message
from std_msgs.msg import Int32

rclpy.init()
node = rclpy.create_node("waiter")
other = rclpy.create_node("sender")
publisher = other.create_publisher(Int32, "t", 1)
print(wait_for_message(Int32, node, "t", time_to_wait=0.1))
stop = threading.Event()


def send():
    while not stop.wait(0.01):
        publisher.publish(Int32(data=3))


thread = threading.Thread(target=send)
thread.start()
print(wait_for_message(Int32, node, "t", time_to_wait=5.0))
stop.set()
thread.join()
rclpy.shutdown()
