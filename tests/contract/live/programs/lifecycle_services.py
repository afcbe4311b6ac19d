"""Changing the state over services."""

import rclpy
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState, GetAvailableTransitions, GetState
from rclpy.executors import SingleThreadedExecutor
from rclpy.lifecycle import LifecycleNode

rclpy.init()
node = LifecycleNode("managed")
asker = rclpy.create_node("asker")
executor = SingleThreadedExecutor()
executor.add_node(node)
executor.add_node(asker)


def ask(kind, name, **fields):
    client = asker.create_client(kind, f"/managed/{name}")
    client.wait_for_service()
    future = client.call_async(kind.Request(**fields))
    executor.spin_until_future_complete(future)
    return future.result()


print(ask(GetState, "get_state").current_state.label)
print(ask(ChangeState, "change_state", transition=Transition(id=Transition.TRANSITION_CONFIGURE)).success)
print(ask(ChangeState, "change_state", transition=Transition(label="activate")).success)
print(ask(GetState, "get_state").current_state.label)
print(
    [each.transition.label for each in ask(GetAvailableTransitions, "get_available_transitions").available_transitions]
)
rclpy.shutdown()
