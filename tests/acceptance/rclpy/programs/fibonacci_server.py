import contextlib
import time

import rclpy
from example_interfaces.action import Fibonacci
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node


class FibonacciServer(Node):
    def __init__(self):
        super().__init__("fibonacci_server")
        self.server = ActionServer(
            self,
            Fibonacci,
            "fibonacci",
            execute_callback=self.execute,
            callback_group=ReentrantCallbackGroup(),
            goal_callback=self.on_goal,
            cancel_callback=self.on_cancel,
        )

    def on_goal(self, goal):
        self.get_logger().info(f"goal of order {goal.order}")
        return GoalResponse.ACCEPT if goal.order > 0 else GoalResponse.REJECT

    def on_cancel(self, handle):
        self.get_logger().info("asked to cancel")
        return CancelResponse.ACCEPT

    def execute(self, handle):
        feedback = Fibonacci.Feedback(sequence=[0, 1])
        time.sleep(0.1)  # feedback of the same instant could overtake the acceptance, here and on ROS 2
        for i in range(1, handle.request.order):
            if handle.is_cancel_requested:
                handle.canceled()
                self.get_logger().info("canceled")
                return Fibonacci.Result(sequence=feedback.sequence)
            feedback.sequence.append(feedback.sequence[i] + feedback.sequence[i - 1])
            handle.publish_feedback(feedback)
            time.sleep(1)
        handle.succeed()
        return Fibonacci.Result(sequence=feedback.sequence)


def main():
    rclpy.init()
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException):
        rclpy.spin(FibonacciServer(), executor=MultiThreadedExecutor())


if __name__ == "__main__":
    main()
