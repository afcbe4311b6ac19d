"""Goals that are rejected, aborted, or left without a state."""

import rclpy
from rclpy.action import ActionClient, ActionServer, GoalResponse

try:
    from example_interfaces.action import Fibonacci
except ImportError:  # PyPI has another package with the same action
    from test_msgs.action import Fibonacci

rclpy.init()
node = rclpy.create_node("picky")


def goal_callback(goal):
    return GoalResponse.ACCEPT if goal.order >= 0 else GoalResponse.REJECT


def execute(goal_handle):
    if goal_handle.request.order == 0:
        goal_handle.abort()
    elif goal_handle.request.order == 1:
        raise RuntimeError("no such luck")
    return Fibonacci.Result(sequence=[goal_handle.request.order])


server = ActionServer(node, Fibonacci, "f", execute, goal_callback=goal_callback)
client = ActionClient(node, Fibonacci, "f")
client.wait_for_server()
for order in (-1, 0, 1, 2):
    sent = client.send_goal_async(Fibonacci.Goal(order=order))
    rclpy.spin_until_future_complete(node, sent)
    handle = sent.result()
    if not handle.accepted:
        print(order, "rejected")
        continue
    result = handle.get_result_async()
    rclpy.spin_until_future_complete(node, result)
    print(order, result.result().status, list(result.result().result.sequence))
rclpy.shutdown()
