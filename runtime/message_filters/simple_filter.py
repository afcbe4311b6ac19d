"""Filters: they receive messages, and pass results on to callbacks."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from rclpy.node import Node
from rclpy.qos import QoSProfile

if TYPE_CHECKING:
    from bot_console.runtime.rosidl.message import Message


class SimpleFilter:
    """Passes messages on to callbacks."""

    def __init__(self) -> None:
        self.callbacks: dict[int, tuple[Callable[..., object], tuple[object, ...]]] = {}

    def registerCallback(self, cb: Callable[..., object], *args: object) -> int:
        """Call `cb(message..., *args)` with each output; returns a number for the callback."""
        number = len(self.callbacks)
        self.callbacks[number] = (cb, args)
        return number

    def signalMessage(self, *msg: object) -> None:
        """Pass an output on."""
        for callback, args in list(self.callbacks.values()):
            callback(*msg, *args)


class Subscriber(SimpleFilter):
    """Passes on the messages of a topic: `Subscriber(node, type, topic, **options of create_subscription)`."""

    def __init__(self, node: Node, msg_type: type[Message], topic: str, *args: Any, **kwargs: Any) -> None:
        super().__init__()
        self.node = node
        self.topic = topic
        if not args:
            kwargs.setdefault("qos_profile", QoSProfile(depth=10))
        self.sub = node.create_subscription(msg_type, topic, self.callback, *args, **kwargs)

    def callback(self, msg: object) -> None:
        """Receive a message."""
        self.signalMessage(msg)

    def getTopic(self) -> str:
        """Return the topic as it was given."""
        return self.topic

    def __getattr__(self, key: str) -> Any:
        """Return any other attribute of the subscription."""
        if key == "sub":
            raise AttributeError(key)
        return getattr(self.sub, key)


class Chain(SimpleFilter):
    """A sequence of filters: each message passes through all of them."""

    def __init__(self, *filters: object) -> None:
        super().__init__()
        self.filters: list[Any] = []
        for each in filters:
            self.addFilter(each)

    def addFilter(self, new_filter: Any) -> int:
        """Append a filter; returns its index."""
        if self.filters:
            self.filters[-1].registerCallback(new_filter.add)
        self.filters.append(new_filter)
        place = len(self.filters)
        new_filter.registerCallback(lambda *msg: self._out(place, *msg))
        return place - 1

    def _out(self, place: int, *msg: object) -> None:
        """Pass on the output of the filter that is now the last one."""
        if place == len(self.filters):
            self.signalMessage(*msg)

    def getFilter(self, index: int) -> Any:
        """Return the filter with this index, None if there is none."""
        return self.filters[index] if 0 <= index < len(self.filters) else None

    def connectInput(self, input_filter: Any) -> None:
        """Connect to the output of another filter."""
        input_filter.registerCallback(self.add)

    def add(self, *msg: object) -> None:
        """Add a message."""
        if self.filters:
            self.filters[0].add(*msg)
