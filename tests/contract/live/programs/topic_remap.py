"""Remapping by arguments given to init."""

import rclpy
from std_msgs.msg import String

rclpy.init(args=["--ros-args", "-r", "chatter:=/robot1/talk", "-r", "__node:=speaker", "-r", "__ns:=/robot1"])
node = rclpy.create_node("talker")
publisher = node.create_publisher(String, "chatter", 10)
other = node.create_publisher(String, "status", 10)
print(node.get_name(), node.get_namespace(), node.get_fully_qualified_name())
print(publisher.topic_name, other.topic_name, publisher.topic)
rclpy.shutdown()
