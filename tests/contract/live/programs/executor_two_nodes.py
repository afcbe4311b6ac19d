"""Two nodes in one executor, spun by hand."""

import rclpy
from rclpy.executors import SingleThreadedExecutor

rclpy.init()
executor = SingleThreadedExecutor()
log = []
for name in ("first", "second"):
    node = rclpy.create_node(name)
    print(executor.add_node(node), executor.add_node(node))
    node.create_guard_condition(lambda name=name: log.append(name)).trigger()
for _ in range(2):
    executor.spin_once(timeout_sec=0.5)
print(sorted(log), sorted(each.get_name() for each in executor.get_nodes()))  # from a set, in any order
executor.remove_node(node)
print(len(executor.get_nodes()))
print(executor.shutdown())
rclpy.shutdown()
