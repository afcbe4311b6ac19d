"""Waits for one message of a topic."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import QoSProfile
from rclpy.task import Future

if TYPE_CHECKING:
    from bot_console.runtime.rosidl.message import Message
    from rclpy.node import Node


def wait_for_message(
    msg_type: type[Message], node: Node, topic: str, *, qos_profile: QoSProfile | int = 1, time_to_wait: float = -1
) -> tuple[bool, Any]:
    """Return the next message of a topic as (True, message), or (False, None) after the time-out (s; negative: none).

    Works with and without an executor that spins the node.
    """
    future: Future[Any] = Future()

    def take(message: object) -> None:
        if not future.done():
            future.set_result(message)

    subscription = node.create_subscription(msg_type, topic, take, qos_profile)
    try:
        timeout = None if time_to_wait < 0 else time_to_wait
        executor = SingleThreadedExecutor(context=node.context)
        # Serve only this subscription, as another executor may be spinning the node.
        subscription.attach(executor, 0)
        executor.spin_until_future_complete(future, timeout)
        return (True, future.result()) if future.done() else (False, None)
    finally:
        node.destroy_subscription(subscription)
