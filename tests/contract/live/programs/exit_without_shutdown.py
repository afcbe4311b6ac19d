"""A program that forgets to shut down."""

import rclpy
from std_msgs.msg import String

rclpy.init()
node = rclpy.create_node("forgets_shutdown")
publisher = node.create_publisher(String, "t", 10)
publisher.publish(String(data="bye"))
print("end")
