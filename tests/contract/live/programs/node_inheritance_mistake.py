"""A class that forgets super().__init__()."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Forgetful(Node):
    def __init__(self):
        self.publisher = self.create_publisher(String, "t", 10)


rclpy.init()
try:
    Forgetful()
except Exception as error:
    print(type(error).__name__)
rclpy.shutdown()
