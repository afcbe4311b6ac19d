"""Publishes again what comes on a topic, changed."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any


class DataRepublisher:
    """Takes messages of one topic, and publishes on another what a function makes of each; None drops it."""

    def __init__(
        self, node: Any, listen_topic: str, publish_topic: str, msg_type: Any, transform_fn: Callable[[Any], Any]
    ) -> None:
        self.__node = node
        self.__transform = transform_fn
        self.__received = 0
        self.__republished: list[Any] = []
        self.__publisher = node.create_publisher(msg_type, publish_topic, 10)
        self.__subscription = node.create_subscription(msg_type, listen_topic, self.__take, 10)

    def __take(self, message: Any) -> None:
        self.__received += 1
        changed = self.__transform(message)
        if changed:
            self.__republished.append(message)
            self.__publisher.publish(changed)

    def shutdown(self) -> None:
        """Stop."""
        self.__node.destroy_subscription(self.__subscription)
        self.__node.destroy_publisher(self.__publisher)

    def get_num_received(self) -> int:
        """How many messages came."""
        return self.__received

    def get_num_republished(self) -> int:
        """How many were published again."""
        return len(self.__republished)

    def get_republished(self) -> list[Any]:
        """The messages that were, as they came."""
        return self.__republished
