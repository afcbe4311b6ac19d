"""Log lines arrive on /rosout."""

import rclpy
from rcl_interfaces.msg import Log

rclpy.init()
node = rclpy.create_node("speaker")
got = []
node.create_subscription(Log, "/rosout", got.append, 10)
while node.count_publishers("/rosout") < 1:
    rclpy.spin_once(node, timeout_sec=0.01)
for _ in range(20):
    rclpy.spin_once(node, timeout_sec=0.01)
node.get_logger().warning("careful")
while not any(each.msg == "careful" for each in got):
    rclpy.spin_once(node, timeout_sec=0.1)
line = next(each for each in got if each.msg == "careful")
print(line.name, line.level, line.function, line.line > 0, line.file.endswith("log_rosout.py"))
rclpy.shutdown()
