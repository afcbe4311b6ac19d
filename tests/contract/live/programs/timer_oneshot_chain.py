"""Each timer creates the next: a small state machine."""

import rclpy
from rclpy.node import Node


class Blinker(Node):
    def __init__(self):
        super().__init__("blinker")
        self.states = iter(["red", "green", "yellow"])
        self.timer = self.create_timer(0.002, self.advance)
        self.done = False

    def advance(self):
        self.timer.cancel()
        self.destroy_timer(self.timer)
        try:
            state = next(self.states)
        except StopIteration:
            self.done = True
            return
        self.get_logger().info(state)
        self.timer = self.create_timer(0.002, self.advance)


rclpy.init()
node = Blinker()
while not node.done:
    rclpy.spin_once(node, timeout_sec=0.1)
rclpy.shutdown()
