import threading

import rclpy

rclpy.init()
node = rclpy.create_node("rates")
thread = threading.Thread(target=rclpy.spin, args=(node,), daemon=True)
thread.start()
rate = node.create_rate(2)
try:
    for count in range(4):
        node.get_logger().info(f"tick {count}")
        rate.sleep()
finally:
    rclpy.shutdown()
    thread.join()
