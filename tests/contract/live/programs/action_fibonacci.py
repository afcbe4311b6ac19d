"""The action of the tutorials: feedback and result."""

import rclpy
from rclpy.action import ActionClient, ActionServer
from rclpy.executors import MultiThreadedExecutor

try:
    from example_interfaces.action import Fibonacci
except ImportError:  # PyPI has another package with the same action
    from test_msgs.action import Fibonacci

rclpy.init()
node = rclpy.create_node("fib")


def execute(goal_handle):
    feedback = Fibonacci.Feedback()
    sequence = [0, 1]
    for i in range(1, goal_handle.request.order):
        sequence.append(sequence[i] + sequence[i - 1])
        feedback.sequence = sequence
        goal_handle.publish_feedback(feedback)
    goal_handle.succeed()
    return Fibonacci.Result(sequence=sequence)


server = ActionServer(node, Fibonacci, "fibonacci", execute)
client = ActionClient(node, Fibonacci, "fibonacci")
client.wait_for_server()
executor = MultiThreadedExecutor(2)
executor.add_node(node)
future = client.send_goal_async(Fibonacci.Goal(order=5))
executor.spin_until_future_complete(future)
handle = future.result()
print(handle.accepted)
result = handle.get_result_async()
executor.spin_until_future_complete(result)
print(result.result().status, list(result.result().result.sequence))
executor.shutdown()
rclpy.shutdown()
