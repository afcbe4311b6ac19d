import contextlib

import rclpy
from lifecycle_msgs.msg import TransitionEvent
from rclpy.executors import ExternalShutdownException
from std_msgs.msg import String


def main():
    rclpy.init()
    node = rclpy.create_node("lc_listener")
    node.create_subscription(String, "lifecycle_chatter", lambda message: print(f"heard {message.data}"), 10)
    node.create_subscription(
        TransitionEvent,
        "/lc_talker/transition_event",
        lambda event: print(f"{event.start_state.label} -> {event.goal_state.label}"),
        10,
    )
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException):
        rclpy.spin(node)


if __name__ == "__main__":
    main()
