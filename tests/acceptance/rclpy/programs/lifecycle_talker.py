import contextlib

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.lifecycle import Node, State, TransitionCallbackReturn
from std_msgs.msg import String


class LifecycleTalker(Node):
    def __init__(self, name, **kwargs):
        self.count = 0
        self.publisher = None
        self.timer = None
        super().__init__(name, **kwargs)

    def talk(self):
        self.count += 1
        if not self.publisher.is_activated:
            self.get_logger().info("inactive, not published")
        self.publisher.publish(String(data=f"hello {self.count}"))

    def on_configure(self, state: State) -> TransitionCallbackReturn:
        self.publisher = self.create_lifecycle_publisher(String, "lifecycle_chatter", 10)
        self.timer = self.create_timer(1.0, self.talk)
        self.get_logger().info(f"on_configure from {state.label}")
        return TransitionCallbackReturn.SUCCESS

    def on_activate(self, state: State) -> TransitionCallbackReturn:
        self.get_logger().info("on_activate")
        return super().on_activate(state)

    def on_deactivate(self, state: State) -> TransitionCallbackReturn:
        self.get_logger().info("on_deactivate")
        return super().on_deactivate(state)

    def on_cleanup(self, state: State) -> TransitionCallbackReturn:
        self.destroy_timer(self.timer)
        self.destroy_lifecycle_publisher(self.publisher)
        self.get_logger().info("on_cleanup")
        return TransitionCallbackReturn.SUCCESS

    def on_shutdown(self, state: State) -> TransitionCallbackReturn:
        self.get_logger().info(f"on_shutdown from {state.label}")
        return TransitionCallbackReturn.SUCCESS


def main():
    rclpy.init()
    executor = rclpy.executors.SingleThreadedExecutor()
    executor.add_node(LifecycleTalker("lc_talker"))
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException):
        executor.spin()


if __name__ == "__main__":
    main()
