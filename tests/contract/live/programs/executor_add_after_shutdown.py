"""The results of an executor's methods after its shutdown."""

import rclpy
from rclpy.executors import SingleThreadedExecutor

rclpy.init()
executor = SingleThreadedExecutor()
node = rclpy.create_node("late")
executor.add_node(node)
executor.shutdown()
executor.spin_once(timeout_sec=0.01)
executor.spin()
print("returned", len(executor.get_nodes()))
rclpy.shutdown()
