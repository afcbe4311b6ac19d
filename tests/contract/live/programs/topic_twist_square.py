"""A robot drives a square: a sequence of Twist messages."""

import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node


class Square(Node):
    def __init__(self):
        super().__init__("square")
        self.cmd = self.create_publisher(Twist, "cmd_vel", 10)
        self.steps = [(0.5, 0.0), (0.0, 1.57)] * 2 + [(0.0, 0.0)]
        self.timer = self.create_timer(0.005, self.step)

    def step(self):
        if not self.steps:
            self.timer.cancel()
            raise SystemExit
        linear, angular = self.steps.pop(0)
        twist = Twist()
        twist.linear.x = linear
        twist.angular.z = angular
        self.cmd.publish(twist)
        self.get_logger().info(f"v={twist.linear.x} w={twist.angular.z}")


def main():
    rclpy.init()
    node = Square()
    try:
        rclpy.spin(node)
    except SystemExit:
        rclpy.logging.get_logger("main").info("square finished")
    node.destroy_node()
    rclpy.shutdown()


main()
