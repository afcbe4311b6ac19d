"""A stamped message: header times from the node's clock."""

import rclpy
from geometry_msgs.msg import PoseStamped
from rclpy.time import Time

rclpy.init()
node = rclpy.create_node("stamped")
message = PoseStamped()
message.header.frame_id = "map"
message.header.stamp = node.get_clock().now().to_msg()
message.pose.orientation.w = 1.0
later = node.get_clock().now()
age = later - Time.from_msg(message.header.stamp)
print(age.nanoseconds >= 0, type(age).__name__, later > Time.from_msg(message.header.stamp))
print(message.pose.position, message.header.frame_id)
rclpy.shutdown()
