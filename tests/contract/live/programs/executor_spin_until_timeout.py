"""spin_until_future_complete with a timeout."""

import rclpy
from rclpy.task import Future

rclpy.init()
node = rclpy.create_node("limit")
future = Future()
print(rclpy.spin_until_future_complete(node, future, timeout_sec=0.05), future.done())
node.create_timer(0.01, lambda: future.set_result("set") if not future.done() else None)
rclpy.spin_until_future_complete(node, future, timeout_sec=5)
print(future.result())
rclpy.shutdown()
