"""Filters: they receive messages and pass their results on to callbacks."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from rclpy.node import Node

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
        """Pass an output on to the callbacks."""
        for callback, args in list(self.callbacks.values()):
            callback(*msg, *args)


class Subscriber(SimpleFilter):
    """Passes on the messages of a topic: `Subscriber(node, type, topic, **options of create_subscription)`.

    As upstream, it raises `TypeError` if the quality of service is not given by the keyword `qos_profile`.
    """

    def __init__(self, node: Node, msg_type: type[Message], topic: str, *args: Any, **kwargs: Any) -> None:
        super().__init__()
        self.node = node
        self.topic = topic
        kwargs.setdefault("qos_profile", 10)
        create: Any = node.create_subscription
        self.sub = create(msg_type, topic, *args, self.callback, **kwargs)

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

    def __init__(self, message_filter: SimpleFilter | None = None) -> None:
        super().__init__()
        self.incoming_connection: int | None = None
        self._filters: list[Any] = []
        if message_filter is not None:
            self.connectInput(message_filter)

    def connectInput(self, message_filter: SimpleFilter) -> None:
        """Connect to the output of another filter; raises `RuntimeError` for a second one."""
        if self.incoming_connection is not None:
            raise RuntimeError("Already connected")
        self.incoming_connection = message_filter.registerCallback(self.add)

    def addFilter(self, message_filter: Any) -> None:
        """Append a filter."""
        if self._filters:
            self._filters[-1].registerCallback(message_filter.add)
        self._filters.append(message_filter)
        place = len(self._filters)
        message_filter.registerCallback(lambda *msg: self._out(place, *msg))

    def _out(self, place: int, *msg: object) -> None:
        """Pass on the output of a filter that is now the last one."""
        if place == len(self._filters):
            self.signalMessage(*msg)

    def getFilter(self, index: int) -> Any:
        """Return the filter with this index; raises `KeyError` if there is none."""
        if not 0 <= index < len(self._filters):
            raise KeyError(index)
        return self._filters[index]

    def add(self, msg: object) -> None:
        """Add a message; a chain without filters passes it on."""
        if self._filters:
            self._filters[0].add(msg)
        else:
            self.signalMessage(msg)
