"""A server that aborts its goal when a new one arrives: the pattern of the single-goal server."""

import contextlib
import threading
import time

import rclpy
from example_interfaces.action import Fibonacci
from rclpy.action import ActionServer
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node


class SingleGoalServer(Node):
    def __init__(self):
        super().__init__("single_goal_server")
        self.goal_handle = None
        self.lock = threading.Lock()
        self.server = ActionServer(
            self,
            Fibonacci,
            "fibonacci",
            execute_callback=self.execute,
            handle_accepted_callback=self.on_accepted,
            callback_group=ReentrantCallbackGroup(),
        )

    def on_accepted(self, handle):
        with self.lock:
            if self.goal_handle is not None and self.goal_handle.is_active:
                self.get_logger().info("aborting the goal before")
                self.goal_handle.abort()
            self.goal_handle = handle
        handle.execute()

    def execute(self, handle):
        for _ in range(handle.request.order):
            if not handle.is_active:
                return Fibonacci.Result()
            time.sleep(1)
        with self.lock:
            if handle.is_active:
                handle.succeed()
        return Fibonacci.Result(sequence=[handle.request.order])


def main():
    rclpy.init()
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException):
        rclpy.spin(SingleGoalServer(), executor=MultiThreadedExecutor(4))


if __name__ == "__main__":
    main()
