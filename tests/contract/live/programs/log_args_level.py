"""--log-level on the command line."""

import rclpy

rclpy.init(args=["--ros-args", "--log-level", "debug", "--log-level", "quiet:=error"])
node = rclpy.create_node("loud")
node.get_logger().debug("debug is shown")
rclpy.logging.get_logger("quiet").warning("not shown")
rclpy.logging.get_logger("quiet").error("shown")
rclpy.shutdown()
