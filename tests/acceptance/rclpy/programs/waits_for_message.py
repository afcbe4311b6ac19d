import rclpy
from rclpy.wait_for_message import wait_for_message
from std_msgs.msg import String

rclpy.init()
node = rclpy.create_node("waits")
node.get_logger().info(str(wait_for_message(String, node, "nothing", time_to_wait=1.5)))
found, msg = wait_for_message(String, node, "chatter", time_to_wait=10)
node.get_logger().info(f"{found}: {msg.data}")
rclpy.shutdown()
