"""Watching parameter events of another node."""

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from rclpy.parameter_event_handler import ParameterEventHandler

rclpy.init()
watched = rclpy.create_node("watched")
watcher = rclpy.create_node("watcher")
executor = SingleThreadedExecutor()
executor.add_node(watched)
executor.add_node(watcher)
seen = []
handler = ParameterEventHandler(watcher)
handler.add_parameter_callback("level", "watched", lambda p: seen.append(("level", p.value.integer_value)))
while not watched.count_subscribers("/parameter_events"):
    executor.spin_once(timeout_sec=0.01)
for _ in range(10):
    executor.spin_once(timeout_sec=0.02)
watched.declare_parameter("level", 1)
watched.set_parameters([Parameter("level", value=2), Parameter("use_sim_time", value=False)])
while len(seen) < 2:
    executor.spin_once(timeout_sec=0.1)
print(seen)
rclpy.shutdown()
