"""Filters: they take messages in, and pass results on to callbacks."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rclpy.node import Node
from rclpy.qos import QoSProfile


class SimpleFilter:
    """Passes messages on to callbacks."""

    def __init__(self) -> None:
        self.callbacks: dict[int, tuple[Callable[..., Any], tuple[Any, ...]]] = {}

    def registerCallback(self, cb: Callable[..., Any], *args: Any) -> int:
        """Call `cb(message..., *args)` with each output; returns a number for the callback."""
        number = len(self.callbacks)
        self.callbacks[number] = (cb, args)
        return number

    def signalMessage(self, *msg: Any) -> None:
        """Pass an output on."""
        for callback, args in list(self.callbacks.values()):
            callback(*msg, *args)


class Subscriber(SimpleFilter):
    """Passes on what comes on a topic: `Subscriber(node, type, topic, **options of create_subscription)`."""

    def __init__(self, node: Node, msg_type: Any, topic: str, *args: Any, **kwargs: Any) -> None:
        super().__init__()
        self.node = node
        self.topic = topic
        if not args:
            kwargs.setdefault("qos_profile", QoSProfile(depth=10))
        self.sub = node.create_subscription(msg_type, topic, self.callback, *args, **kwargs)

    def callback(self, msg: Any) -> None:
        """Take a message."""
        self.signalMessage(msg)

    def getTopic(self) -> str:
        """The topic as it was given."""
        return self.topic

    def __getattr__(self, key: str) -> Any:
        """What else a subscription has."""
        if key == "sub":
            raise AttributeError(key)
        return getattr(self.sub, key)


class Chain(SimpleFilter):
    """Filters one behind the other: what goes in passes through all of them."""

    def __init__(self, *filters: Any) -> None:
        super().__init__()
        self.filters: list[Any] = []
        for each in filters:
            self.addFilter(each)

    def addFilter(self, new_filter: Any) -> int:
        """Put a filter behind the last one; returns its place."""
        if self.filters:
            self.filters[-1].registerCallback(new_filter.add)
        self.filters.append(new_filter)
        place = len(self.filters)
        new_filter.registerCallback(lambda *msg: self._out(place, *msg))
        return place - 1

    def _out(self, place: int, *msg: Any) -> None:
        """Pass on what the filter that is now the last one gives."""
        if place == len(self.filters):
            self.signalMessage(*msg)

    def getFilter(self, index: int) -> Any:
        """The filter at a place, None where there is none."""
        return self.filters[index] if 0 <= index < len(self.filters) else None

    def connectInput(self, input_filter: Any) -> None:
        """Take what another filter gives."""
        input_filter.registerCallback(self.add)

    def add(self, *msg: Any) -> None:
        """Put a message in."""
        if self.filters:
            self.filters[0].add(*msg)
