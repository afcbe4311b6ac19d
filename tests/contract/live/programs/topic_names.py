"""Relative, absolute and private names."""

import rclpy
from std_msgs.msg import String

rclpy.init()
node = rclpy.create_node("arm", namespace="factory/cell1")
for name in ("state", "/state", "~/state", "a/b", "{node}/x"):
    print(name, "->", node.create_publisher(String, name, 1).topic_name)
for name in ("bad name", "1x", "a//b", "a/", "~x", ""):
    try:
        node.create_publisher(String, name, 1)
    except Exception as error:
        print(name, type(error).__name__, str(error).splitlines()[0])
print(node.resolve_topic_name("state"), node.resolve_service_name("~/reset"))
rclpy.shutdown()
