"""The action client class of the tutorials, with its three callbacks."""

import rclpy
from action_msgs.msg import GoalStatus
from rclpy.action import ActionClient, ActionServer
from rclpy.node import Node

try:
    from example_interfaces.action import Fibonacci
except ImportError:  # PyPI has another package with the same action
    from test_msgs.action import Fibonacci


class Client(Node):
    def __init__(self):
        super().__init__("fibonacci_action_client")
        self._action_client = ActionClient(self, Fibonacci, "fibonacci")
        self.finished = False

    def send_goal(self, order):
        self._action_client.wait_for_server()
        self._future = self._action_client.send_goal_async(Fibonacci.Goal(order=order))
        self._future.add_done_callback(self.goal_response_callback)

    def goal_response_callback(self, future):
        goal_handle = future.result()
        if not goal_handle.accepted:
            self.get_logger().info("Goal rejected :(")
            return
        self.get_logger().info("Goal accepted :)")
        goal_handle.get_result_async().add_done_callback(self.get_result_callback)

    def get_result_callback(self, future):
        result = future.result()
        self.get_logger().info(f"Result: {list(result.result.sequence)} {result.status == GoalStatus.STATUS_SUCCEEDED}")
        self.finished = True


def execute(goal_handle):
    goal_handle.succeed()
    return Fibonacci.Result(sequence=[goal_handle.request.order] * 2)


rclpy.init()
node = Client()
server = ActionServer(node, Fibonacci, "fibonacci", execute)
node.send_goal(4)
while not node.finished:
    rclpy.spin_once(node, timeout_sec=0.1)
node.destroy_node()
rclpy.shutdown()
