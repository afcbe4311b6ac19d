"""Two timers: the faster one fires more often, in order of creation when both are due."""

import rclpy

rclpy.init()
node = rclpy.create_node("rates")
log = []
node.create_timer(0.01, lambda: log.append("fast"))
node.create_timer(0.02, lambda: log.append("slow"))
while log.count("slow") < 3:
    rclpy.spin_once(node, timeout_sec=0.1)
print(log[0], log.count("fast") >= log.count("slow"))
rclpy.shutdown()
