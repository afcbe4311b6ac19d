import sys

import rclpy
from action_msgs.msg import GoalStatus
from example_interfaces.action import Fibonacci
from rclpy.action import ActionClient
from rclpy.node import Node


class FibonacciClient(Node):
    def __init__(self, order, cancel_after):
        super().__init__("fibonacci_client")
        self.cancel_after = cancel_after
        self.done = False
        self.client = ActionClient(self, Fibonacci, "fibonacci")
        self.client.wait_for_server()
        sent = self.client.send_goal_async(Fibonacci.Goal(order=order), feedback_callback=self.on_feedback)
        sent.add_done_callback(self.on_response)

    def on_response(self, future):
        handle = future.result()
        if not handle.accepted:
            self.get_logger().info("rejected")
            self.done = True
            return
        self.get_logger().info("accepted")
        handle.get_result_async().add_done_callback(self.on_result)
        if self.cancel_after:
            self.timer = self.create_timer(self.cancel_after, lambda: self.cancel(handle))

    def on_feedback(self, message):
        self.get_logger().info(f"feedback {list(message.feedback.sequence)}")

    def cancel(self, handle):
        self.timer.cancel()
        handle.cancel_goal_async().add_done_callback(self.on_cancel)

    def on_cancel(self, future):
        self.get_logger().info(f"canceling {len(future.result().goals_canceling)}")

    def on_result(self, future):
        answer = future.result()
        names = {GoalStatus.STATUS_SUCCEEDED: "succeeded", GoalStatus.STATUS_CANCELED: "canceled"}
        self.get_logger().info(f"{names[answer.status]} {list(answer.result.sequence)}")
        self.done = True


def main():
    rclpy.init()
    node = FibonacciClient(int(sys.argv[1]), float(sys.argv[2]))
    while not node.done:
        rclpy.spin_once(node)
    node.destroy_node()
    rclpy.shutdown()


if __name__ == "__main__":
    main()
