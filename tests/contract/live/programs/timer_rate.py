"""A Rate in a separate thread."""

import threading

import rclpy

rclpy.init()
node = rclpy.create_node("rate")
thread = threading.Thread(target=rclpy.spin, args=(node,), daemon=True)
thread.start()
rate = node.create_rate(100)
count = 0
while rclpy.ok() and count < 3:
    rate.sleep()
    count += 1
print("slept", count)
node.destroy_rate(rate)
rclpy.shutdown()
thread.join()
