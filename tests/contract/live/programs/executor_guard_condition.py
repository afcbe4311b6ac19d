"""A guard condition triggered by a thread."""

import threading

import rclpy

rclpy.init()
node = rclpy.create_node("guard")
count = []
guard = node.create_guard_condition(lambda: count.append(threading.current_thread() is threading.main_thread()))
threading.Timer(0.05, guard.trigger).start()
rclpy.spin_once(node, timeout_sec=5)
print(count)
rclpy.spin_once(node, timeout_sec=0.05)
print(len(count), node.destroy_guard_condition(guard))
rclpy.shutdown()
