"""A lifecycle node through all its states."""

import rclpy
from rclpy.lifecycle import LifecycleNode, State, TransitionCallbackReturn
from std_msgs.msg import String


class Managed(LifecycleNode):
    def on_configure(self, state: State):
        self.get_logger().info(f"on_configure() from {state.label}")
        self.pub = self.create_lifecycle_publisher(String, "out", 10)
        return super().on_configure(state)

    def on_activate(self, state):
        self.get_logger().info("on_activate()")
        return super().on_activate(state)

    def on_deactivate(self, state):
        self.get_logger().info("on_deactivate()")
        return super().on_deactivate(state)

    def on_cleanup(self, state):
        self.destroy_publisher(self.pub)
        return TransitionCallbackReturn.SUCCESS

    def on_shutdown(self, state):
        self.get_logger().info(f"on_shutdown() from {state.label}")
        return TransitionCallbackReturn.SUCCESS


rclpy.init()
node = Managed("managed")
for step in ("configure", "activate", "deactivate", "activate", "deactivate", "shutdown"):
    print(step, getattr(node, f"trigger_{step}")(), node._state_machine.current_state)
try:
    node.trigger_configure()
except Exception as error:
    print(type(error).__name__)
rclpy.shutdown()
