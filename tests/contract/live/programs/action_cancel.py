"""A goal is cancelled while it runs."""

import time

import rclpy
from rclpy.action import ActionClient, ActionServer, CancelResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor

try:
    from example_interfaces.action import Fibonacci
except ImportError:  # PyPI has another package with the same action
    from test_msgs.action import Fibonacci

rclpy.init()
node = rclpy.create_node("cancel")
group = ReentrantCallbackGroup()


def execute(goal_handle):
    for _ in range(2000):
        if goal_handle.is_cancel_requested:
            goal_handle.canceled()
            return Fibonacci.Result(sequence=[-1])
        time.sleep(0.005)
    goal_handle.succeed()
    return Fibonacci.Result()


server = ActionServer(
    node, Fibonacci, "f", execute, cancel_callback=lambda handle: CancelResponse.ACCEPT, callback_group=group
)
client = ActionClient(node, Fibonacci, "f", callback_group=group)
executor = MultiThreadedExecutor(4)
executor.add_node(node)
client.wait_for_server()
sent = client.send_goal_async(Fibonacci.Goal(order=1))
executor.spin_until_future_complete(sent)
result = sent.result().get_result_async()
cancel = sent.result().cancel_goal_async()
executor.spin_until_future_complete(cancel)
print(len(cancel.result().goals_canceling), cancel.result().return_code)
executor.spin_until_future_complete(result)
print(result.result().status, list(result.result().result.sequence))
executor.shutdown()
rclpy.shutdown()
