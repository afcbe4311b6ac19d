"""A new goal aborts the old one, by handle_accepted_callback."""

import rclpy
from rclpy.action import ActionClient, ActionServer

try:
    from example_interfaces.action import Fibonacci
except ImportError:  # PyPI has another package with the same action
    from test_msgs.action import Fibonacci

rclpy.init()
node = rclpy.create_node("single")
state = {"handle": None}


def accepted(goal_handle):
    old = state["handle"]
    if old is not None and old.is_active:
        node.get_logger().info("Aborting previous goal")
        old.abort()
    state["handle"] = goal_handle


def execute(goal_handle):
    if not goal_handle.is_active:
        return Fibonacci.Result(sequence=[0])
    goal_handle.succeed()
    return Fibonacci.Result(sequence=[1])


server = ActionServer(node, Fibonacci, "f", execute, handle_accepted_callback=accepted)
client = ActionClient(node, Fibonacci, "f")
client.wait_for_server()
handles = []
for order in (1, 2):
    sent = client.send_goal_async(Fibonacci.Goal(order=order))
    rclpy.spin_until_future_complete(node, sent)
    handles.append(sent.result())
    if order == 1:
        state["handle"].execute()
        for _ in range(10):
            rclpy.spin_once(node, timeout_sec=0.02)
    else:
        state["handle"].execute()
for handle in handles:
    result = handle.get_result_async()
    rclpy.spin_until_future_complete(node, result)
    print(result.result().status, list(result.result().result.sequence))
rclpy.shutdown()
