"""Republishes modified messages of a topic."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from bot_console.runtime.rosidl.message import Message
    from rclpy.node import Node


class DataRepublisher:
    """Receives messages of one topic and publishes a function's result for each on another topic; None drops it."""

    def __init__(
        self,
        node: Node,
        listen_topic: str,
        publish_topic: str,
        msg_type: type[Message],
        transform_fn: Callable[[Any], Any],
    ) -> None:
        self.__node = node
        self.__transform = transform_fn
        self.__received = 0
        self.__republished: list[Any] = []
        self.__publisher = node.create_publisher(msg_type, publish_topic, 10)
        self.__subscription = node.create_subscription(msg_type, listen_topic, self.__take, 10)

    def __take(self, message: object) -> None:
        self.__received += 1
        changed = self.__transform(message)
        if changed:
            self.__republished.append(message)
            self.__publisher.publish(changed)

    def shutdown(self) -> None:
        """Stop republishing."""
        self.__node.destroy_subscription(self.__subscription)
        self.__node.destroy_publisher(self.__publisher)

    def get_num_received(self) -> int:
        """Return the number of received messages."""
        return self.__received

    def get_num_republished(self) -> int:
        """Return the number of republished messages."""
        return len(self.__republished)

    def get_republished(self) -> list[Any]:
        """Return the messages that were republished, as they were received."""
        return self.__republished
