"""QoS events of publishers and subscriptions."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from enum import IntEnum
from typing import Any

from rclpy._rclpy_pybind11 import UnsupportedEventTypeError
from rclpy.impl.entity import WAITABLE, Entity

__all__ = [
    "EventHandler",
    "PublisherEventCallbacks",
    "QoSPublisherMatchedInfo",
    "QoSSubscriptionMatchedInfo",
    "SubscriptionEventCallbacks",
    "UnsupportedEventTypeError",
]


class QoSPolicyKind(IntEnum):
    """The numbers by which rmw names policies."""

    INVALID = 1
    DURABILITY = 2
    DEADLINE = 4
    LIVELINESS = 8
    RELIABILITY = 16
    HISTORY = 32
    LIFESPAN = 64


@dataclass
class QoSIncompatibleInfo:
    """Endpoints that do not fit: how many, how many new, and the last policy in which they did not."""

    total_count: int = 0
    total_count_change: int = 0
    last_policy_kind: int = QoSPolicyKind.INVALID


@dataclass
class QoSMatchedInfo:
    """Matched endpoints: ever, newly, now, and the change of the last."""

    total_count: int = 0
    total_count_change: int = 0
    current_count: int = 0
    current_count_change: int = 0


class QoSPublisherMatchedInfo(QoSMatchedInfo):
    """What a publisher's matched event says."""


class QoSSubscriptionMatchedInfo(QoSMatchedInfo):
    """What a subscription's matched event says."""


class QoSOfferedIncompatibleQoSInfo(QoSIncompatibleInfo):
    """What a publisher's incompatible event says."""


class QoSRequestedIncompatibleQoSInfo(QoSIncompatibleInfo):
    """What a subscription's incompatible event says."""


class EventHandler(Entity):
    """Calls back in the executor when an event of one kind has come."""

    KIND = WAITABLE

    def __init__(self, kind: str, info_type: Any, callback: Callable[[Any], Any], callback_group: Any) -> None:
        super().__init__(callback_group)
        self.kind = kind
        self._info_type = info_type
        self._callback = callback
        self._totals = [0, 0]
        self._queue: deque[Any] = deque(maxlen=1)

    def happened(self, what: Any) -> None:
        """An event has come; from any thread."""
        last = self._queue.pop() if self._queue else None
        if self.kind == "matched":
            self._totals[0] += max(0, what)
            self._totals[1] += what
            new = self._info_type(self._totals[0], max(0, what), self._totals[1], what)
            if last is not None:
                new.total_count_change += last.total_count_change
                new.current_count_change += last.current_count_change
        else:
            self._totals[0] += 1
            new = self._info_type(self._totals[0], 1 + (last.total_count_change if last else 0), QoSPolicyKind[what])
        self._queue.append(new)
        self.notify()

    def pending(self) -> bool:
        """Whether an event is there."""
        return bool(self._queue) and not self.destroyed

    def run(self) -> Any:
        """Call back."""
        if self._queue:
            self._callback(self._queue.pop())

    def destroy(self) -> None:
        """Call back no more."""
        self.destroyed = True
        self.detach()


@dataclass
class _EventCallbacks:
    incompatible_qos: Callable[[Any], None] | None = None
    liveliness: Callable[[Any], None] | None = None
    deadline: Callable[[Any], None] | None = None
    incompatible_type: Callable[[Any], None] | None = None
    matched: Callable[[Any], None] | None = None
    use_default_callbacks: bool = True

    def _handlers(self, group: Any, logger: Any, topic: str, infos: tuple[Any, Any], words: str) -> list[EventHandler]:
        incompatible = self.incompatible_qos
        if incompatible is None and self.use_default_callbacks:

            def incompatible(info: Any) -> None:
                policy = QoSPolicyKind(info.last_policy_kind).name
                logger().warn(words.format(topic, policy))

        handlers: list[EventHandler] = []
        if incompatible is not None:
            handlers.append(EventHandler("incompatible", infos[0], incompatible, group))
        if self.matched is not None:
            handlers.append(EventHandler("matched", infos[1], self.matched, group))
        return handlers


class SubscriptionEventCallbacks(_EventCallbacks):
    """Callbacks for events of a subscription."""

    def __init__(
        self,
        *,
        incompatible_qos: Callable[[Any], None] | None = None,
        liveliness: Callable[[Any], None] | None = None,
        deadline: Callable[[Any], None] | None = None,
        message_lost: Callable[[Any], None] | None = None,
        incompatible_type: Callable[[Any], None] | None = None,
        matched: Callable[[Any], None] | None = None,
        use_default_callbacks: bool = True,
    ) -> None:
        super().__init__(incompatible_qos, liveliness, deadline, incompatible_type, matched, use_default_callbacks)
        self.message_lost = message_lost

    def create_event_handlers(self, callback_group: Any, logger: Any, topic: str) -> list[EventHandler]:
        """The handlers of a subscription to a topic."""
        words = (
            "New publisher discovered on topic '{}', offering incompatible QoS. No messages will be received from it. "
            "Last incompatible policy: {}"
        )
        infos = (QoSRequestedIncompatibleQoSInfo, QoSSubscriptionMatchedInfo)
        return self._handlers(callback_group, logger, topic, infos, words)


class PublisherEventCallbacks(_EventCallbacks):
    """Callbacks for events of a publisher."""

    def __init__(
        self,
        *,
        incompatible_qos: Callable[[Any], None] | None = None,
        liveliness: Callable[[Any], None] | None = None,
        deadline: Callable[[Any], None] | None = None,
        incompatible_type: Callable[[Any], None] | None = None,
        matched: Callable[[Any], None] | None = None,
        use_default_callbacks: bool = True,
    ) -> None:
        super().__init__(incompatible_qos, liveliness, deadline, incompatible_type, matched, use_default_callbacks)

    def create_event_handlers(self, callback_group: Any, logger: Any, topic: str) -> list[EventHandler]:
        """The handlers of a publisher of a topic."""
        words = (
            "New subscription discovered on topic '{}', requesting incompatible QoS. No messages will be sent to it. "
            "Last incompatible policy: {}"
        )
        infos = (QoSOfferedIncompatibleQoSInfo, QoSPublisherMatchedInfo)
        return self._handlers(callback_group, logger, topic, infos, words)
