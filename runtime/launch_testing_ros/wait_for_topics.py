"""Waits for messages on topics."""

from __future__ import annotations

import contextlib
import random
import string
import threading
from collections.abc import Callable, Iterable
from functools import partial
from typing import Any

import rclpy
from rclpy.context import Context
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node


class WaitForTopics:
    """Waits for messages on topics, pairs of name and type, as a context manager or with `wait` and `shutdown`."""

    def __init__(
        self,
        topic_tuples: Iterable[tuple[str, Any]],
        timeout: float = 5.0,
        messages_received_buffer_length: int = 10,
        callback: Callable[..., object] | None = None,
        callback_arguments: object = None,
        node_namespace: str | None = None,
    ) -> None:
        self.topic_tuples = list(topic_tuples)
        self.timeout = timeout
        self._length = messages_received_buffer_length
        self._messages: dict[str, list[Any]] = {}
        self._all_there = threading.Event()
        self._context = Context()
        rclpy.init(context=self._context)
        characters = "".join(random.choices(string.ascii_lowercase, k=10))
        self._node = Node(f"_test_node_{characters}", context=self._context, namespace=node_namespace)
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self._node)
        for name, kind in self.topic_tuples:
            self._node.create_subscription(kind, name, partial(self._take, name), 10)
        self._callback: Callable[[], object] | None = None
        if callback is not None:
            arguments = () if callback_arguments is None else (callback_arguments,)
            self._callback = partial(callback, self._node, *arguments)
        self._thread = threading.Thread(target=self._spin, daemon=True)
        self._thread.start()

    def _spin(self) -> None:
        with contextlib.suppress(ExternalShutdownException):
            self._executor.spin()

    def _take(self, name: str, message: object) -> None:
        kept = self._messages.setdefault(name, [])
        kept.append(message)
        del kept[: -self._length]
        if len(self._messages) == len({each for each, _ in self.topic_tuples}):
            self._all_there.set()

    def wait(self) -> bool:
        """Return whether messages arrived on all topics in time; the first call runs the callback first."""
        callback, self._callback = self._callback, None
        if callback is not None:
            callback()
        return self._all_there.wait(self.timeout)

    def shutdown(self) -> None:
        """Leave the graph."""
        self._executor.shutdown()
        self._thread.join(timeout=5.0)
        self._node.destroy_node()
        self._context.try_shutdown()

    def topics_received(self) -> set[str]:
        """Return the topics with messages."""
        return set(self._messages)

    def topics_not_received(self) -> set[str]:
        """Return the topics without messages."""
        return {name for name, _ in self.topic_tuples} - set(self._messages)

    def received_messages(self, topic_name: str) -> list[Any]:
        """Return the newest messages of a topic; raises `KeyError` for a topic that is not waited for."""
        if topic_name not in {name for name, _ in self.topic_tuples}:
            raise KeyError(f"No topic '{topic_name}' is waited for")
        return list(self._messages.get(topic_name, []))

    def __enter__(self) -> WaitForTopics:
        if not self.wait():
            missing = self.topics_not_received()
            self.shutdown()
            raise RuntimeError(f"Did not receive messages on these topics: {missing}")
        return self

    def __exit__(self, *_: object) -> None:
        self.shutdown()
