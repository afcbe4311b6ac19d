import sys
import time

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Slow(Node):
    def __init__(self, group, other):
        super().__init__("slow")
        self.create_timer(1.0, lambda: self.work("a"), callback_group=group)
        self.create_timer(1.0, lambda: self.work("b"), callback_group=other)

    def work(self, name):
        self.get_logger().info(f"{name} begins")
        time.sleep(0.4)
        self.get_logger().info(f"{name} ends")


rclpy.init()
exclusive, reentrant = MutuallyExclusiveCallbackGroup(), ReentrantCallbackGroup()
groups = {
    "one": (exclusive, exclusive),
    "two": (exclusive, MutuallyExclusiveCallbackGroup()),
    "reentrant": (reentrant, reentrant),
}[sys.argv[1]]
executor = MultiThreadedExecutor(num_threads=4)
executor.add_node(Slow(*groups))
executor.spin()
