import threading

import rclpy

rclpy.init()
node = rclpy.create_node("guarded")
executor = rclpy.executors.SingleThreadedExecutor()
executor.add_node(node)
guard = node.create_guard_condition(lambda: node.get_logger().info("guard condition callback called"))
threading.Timer(1.0, guard.trigger).start()
executor.spin_once(timeout_sec=0.5)
node.get_logger().info("nothing yet")
executor.spin_once(timeout_sec=5.0)
rclpy.shutdown()
