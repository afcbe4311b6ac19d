"""QoS events of publishers and subscriptions."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

from rclpy._rclpy_pybind11 import UnsupportedEventTypeError, rmw_qos_policy_kind_t
from rclpy.impl.event_handlers import (
    EventHandler,
    IncompatibleHandler,
    LivelinessHandler,
    LostHandler,
    MatchedHandler,
    MissedHandler,
)
from rclpy.impl.named_enum import NamedIntEnum
from rclpy.impl.qos_policies import QoSPolicyKind
from rclpy.impl.reexports import reexporting
from rclpy.qos import LivelinessPolicy, QoSProfile

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rclpy.callback_groups import CallbackGroup
    from rclpy.duration import Duration
    from rclpy.impl.rcutils_logger import RcutilsLogger

__all__ = [
    "EventHandler",
    "IncompatibleTypeInfo",
    "PublisherEventCallbacks",
    "QoSLivelinessChangedInfo",
    "QoSLivelinessLostInfo",
    "QoSMessageLostInfo",
    "QoSOfferedDeadlineMissedInfo",
    "QoSOfferedIncompatibleQoSInfo",
    "QoSPublisherEventType",
    "QoSPublisherMatchedInfo",
    "QoSRequestedDeadlineMissedInfo",
    "QoSRequestedIncompatibleQoSInfo",
    "QoSSubscriptionEventType",
    "QoSSubscriptionMatchedInfo",
    "SubscriptionEventCallbacks",
    "UnsupportedEventTypeError",
]

Callback = Callable[[Any], object]
INFINITE_NS = 2**63 - 2
"""Durations (ns) from which on there is no limit."""


class QoSPublisherEventType(NamedIntEnum):
    """Events of publishers, with rcl's numbers."""

    RCL_PUBLISHER_OFFERED_DEADLINE_MISSED = 0
    RCL_PUBLISHER_LIVELINESS_LOST = 1
    RCL_PUBLISHER_OFFERED_INCOMPATIBLE_QOS = 2
    RCL_PUBLISHER_INCOMPATIBLE_TYPE = 3
    RCL_PUBLISHER_MATCHED = 4


class QoSSubscriptionEventType(NamedIntEnum):
    """Events of subscriptions, with rcl's numbers."""

    RCL_SUBSCRIPTION_REQUESTED_DEADLINE_MISSED = 0
    RCL_SUBSCRIPTION_LIVELINESS_CHANGED = 1
    RCL_SUBSCRIPTION_REQUESTED_INCOMPATIBLE_QOS = 2
    RCL_SUBSCRIPTION_MESSAGE_LOST = 3
    RCL_SUBSCRIPTION_INCOMPATIBLE_TYPE = 4
    RCL_SUBSCRIPTION_MATCHED = 5


class QoSIncompatibleInfo(NamedTuple):
    """Incompatible endpoints: the total, the change, and the last policy that did not match."""

    total_count: int = 0
    total_count_change: int = 0
    last_policy_kind: rmw_qos_policy_kind_t = rmw_qos_policy_kind_t(QoSPolicyKind.INVALID.value)


class QoSMatchedInfo(NamedTuple):
    """Matched endpoints: the total ever, its change, the current number, and its change."""

    total_count: int = 0
    total_count_change: int = 0
    current_count: int = 0
    current_count_change: int = 0


class QoSCountInfo(NamedTuple):
    """How often something has happened: the total, and the change since the last call."""

    total_count: int = 0
    total_count_change: int = 0


class QoSLivelinessChangedInfo(NamedTuple):
    """How many publishers are alive and how many are not, and the changes since the last call."""

    alive_count: int = 0
    not_alive_count: int = 0
    alive_count_change: int = 0
    not_alive_count_change: int = 0


class QoSPublisherMatchedInfo(QoSMatchedInfo):
    """The data of a publisher's matched event."""


class QoSSubscriptionMatchedInfo(QoSMatchedInfo):
    """The data of a subscription's matched event."""


class QoSOfferedIncompatibleQoSInfo(QoSIncompatibleInfo):
    """The data of a publisher's incompatible event."""


class QoSRequestedIncompatibleQoSInfo(QoSIncompatibleInfo):
    """The data of a subscription's incompatible event."""


class QoSOfferedDeadlineMissedInfo(QoSCountInfo):
    """The data of a publisher's deadline event."""


class QoSRequestedDeadlineMissedInfo(QoSCountInfo):
    """The data of a subscription's deadline event."""


class QoSLivelinessLostInfo(QoSCountInfo):
    """The data of a publisher's liveliness event."""


class QoSMessageLostInfo(QoSCountInfo):
    """The data of a subscription's message lost event; within one process no message is lost."""


class IncompatibleTypeInfo(QoSCountInfo):
    """The data of an event about an endpoint with another message type."""


class _EventCallbacks:
    _WORDS: str
    _INCOMPATIBLE: type[QoSIncompatibleInfo]
    _MATCHED: type[QoSMatchedInfo]
    _DEADLINE: type[QoSCountInfo]

    def __init__(
        self,
        *,
        incompatible_qos: Callback | None = None,
        liveliness: Callback | None = None,
        deadline: Callback | None = None,
        incompatible_type: Callback | None = None,
        matched: Callback | None = None,
        use_default_callbacks: bool = True,
    ) -> None:
        self.incompatible_qos = incompatible_qos
        self.liveliness = liveliness
        self.deadline = deadline
        self.incompatible_type = incompatible_type
        self.matched = matched
        self.use_default_callbacks = use_default_callbacks

    def create_event_handlers(
        self, callback_group: CallbackGroup, logger: Callable[[], RcutilsLogger], topic: str, qos: QoSProfile
    ) -> list[EventHandler]:
        """Return the handlers of a publisher or subscription of a topic."""
        handlers: list[EventHandler] = []
        incompatible = self.incompatible_qos or (self._warner(logger, topic) if self.use_default_callbacks else None)
        if incompatible is not None:
            handlers.append(IncompatibleHandler(self._INCOMPATIBLE, incompatible, callback_group))
        if self.matched is not None:
            handlers.append(MatchedHandler(self._MATCHED, self.matched, callback_group))
        deadline = limit(qos.deadline)
        if self.deadline is not None and deadline is not None:
            handlers.append(MissedHandler(self._DEADLINE, self.deadline, callback_group, deadline, again=True))
        if self.liveliness is not None:
            handlers += self._liveliness(self.liveliness, callback_group, qos)
        return handlers

    def _warner(self, logger: Callable[[], RcutilsLogger], topic: str) -> Callback:
        def warn(info: QoSIncompatibleInfo) -> None:
            logger().warning(self._WORDS.format(topic, QoSPolicyKind(info.last_policy_kind).name))

        return warn

    def _liveliness(self, callback: Callback, group: CallbackGroup, qos: QoSProfile) -> Sequence[EventHandler]:
        raise NotImplementedError


class SubscriptionEventCallbacks(_EventCallbacks):
    """Callbacks for events of a subscription."""

    _WORDS = (
        "New publisher discovered on topic '{}', offering incompatible QoS. No messages will be received from it. "
        "Last incompatible policy: {}"
    )
    _INCOMPATIBLE = QoSRequestedIncompatibleQoSInfo
    _MATCHED = QoSSubscriptionMatchedInfo
    _DEADLINE = QoSRequestedDeadlineMissedInfo

    def __init__(self, *, message_lost: Callback | None = None, **callbacks: Any) -> None:
        super().__init__(**callbacks)
        self.message_lost = message_lost

    def create_event_handlers(
        self, callback_group: CallbackGroup, logger: Callable[[], RcutilsLogger], topic: str, qos: QoSProfile
    ) -> list[EventHandler]:
        """Return the handlers of a subscription of a topic."""
        handlers = super().create_event_handlers(callback_group, logger, topic, qos)
        if self.message_lost is not None:
            handlers.append(LostHandler(QoSMessageLostInfo, self.message_lost, callback_group))
        return handlers

    def _liveliness(self, callback: Callback, group: CallbackGroup, qos: QoSProfile) -> Sequence[EventHandler]:
        return [LivelinessHandler(QoSLivelinessChangedInfo, callback, group)]


class PublisherEventCallbacks(_EventCallbacks):
    """Callbacks for events of a publisher."""

    _WORDS = (
        "New subscription discovered on topic '{}', requesting incompatible QoS. No messages will be sent to it. "
        "Last incompatible policy: {}"
    )
    _INCOMPATIBLE = QoSOfferedIncompatibleQoSInfo
    _MATCHED = QoSPublisherMatchedInfo
    _DEADLINE = QoSOfferedDeadlineMissedInfo

    def _liveliness(self, callback: Callback, group: CallbackGroup, qos: QoSProfile) -> Sequence[EventHandler]:
        lease = limit(qos.liveliness_lease_duration)
        if lease is None or qos.liveliness is not LivelinessPolicy.MANUAL_BY_TOPIC:
            return []  # a publisher is alive as long as its process is
        return [MissedHandler(QoSLivelinessLostInfo, callback, group, lease, again=False)]


def limit(duration: Duration) -> int | None:
    """Return a profile's duration in ns; None if it means no limit."""
    return duration.nanoseconds if 0 < duration.nanoseconds < INFINITE_NS else None


QoSEventHandler = EventHandler
"""The class's older name."""

__getattr__ = reexporting(__name__, "CallbackGroup NumberOfEntities Waitable get_logger qos_policy_name_from_kind")
