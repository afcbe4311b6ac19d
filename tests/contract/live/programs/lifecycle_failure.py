"""Callbacks that fail or raise."""

import rclpy
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn


class Shaky(LifecycleNode):
    def __init__(self):
        super().__init__("shaky")
        self.answers = [
            TransitionCallbackReturn.FAILURE,
            TransitionCallbackReturn.ERROR,
            TransitionCallbackReturn.SUCCESS,
        ]

    def on_configure(self, state):
        return self.answers.pop(0)

    def on_error(self, state):
        self.get_logger().info(f"on_error from {state.label}")
        return TransitionCallbackReturn.SUCCESS


rclpy.init()
node = Shaky()
for _ in range(3):
    print(node.trigger_configure(), node._state_machine.current_state[1])
rclpy.shutdown()
