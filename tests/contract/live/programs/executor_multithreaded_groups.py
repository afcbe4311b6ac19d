"""Mutually exclusive callbacks never overlap; reentrant ones may."""

import threading
import time

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor

rclpy.init()
node = rclpy.create_node("groups")
busy = {"exclusive": 0, "reentrant": 0}
most = {"exclusive": 0, "reentrant": 0}
lock = threading.Lock()
calls = []


def work(kind):
    with lock:
        busy[kind] += 1
        most[kind] = max(most[kind], busy[kind])
    time.sleep(0.02)
    with lock:
        busy[kind] -= 1
        calls.append(kind)


exclusive, reentrant = MutuallyExclusiveCallbackGroup(), ReentrantCallbackGroup()
for _ in range(2):
    node.create_timer(0.005, lambda: work("exclusive"), callback_group=exclusive)
    node.create_timer(0.005, lambda: work("reentrant"), callback_group=reentrant)
executor = MultiThreadedExecutor(num_threads=4)
executor.add_node(node)
end = time.time() + 0.5
while time.time() < end:
    executor.spin_once(timeout_sec=0.05)
print(most["exclusive"], most["reentrant"] > 1, len(calls) > 4)
executor.shutdown()
rclpy.shutdown()
