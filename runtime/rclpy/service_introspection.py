"""Service introspection: publishes the activity of a service or client on `<service>/_service_event`."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

from bot_console.runtime.rmw.endpoints import ClientEndpoint
from rclpy.impl.named_enum import NamedIntEnum

if TYPE_CHECKING:
    from bot_console.runtime.rosidl.message import Message, ServiceType
    from rclpy.clock import Clock
    from rclpy.node_parts.base import NodeBase
    from rclpy.publisher import Publisher
    from rclpy.qos import QoSProfile

EVENT_TOPIC = "/_service_event"


class ServiceIntrospectionState(NamedIntEnum):
    """How much of the activity is published."""

    OFF = 0
    METADATA = 1
    CONTENTS = 2


class IntrospectedEntity(Protocol):
    """What introspection needs of a service or client."""

    srv_type: ServiceType
    events: ServiceEvents | None
    _node: NodeBase

    @property
    def service_name(self) -> str:
        """The fully qualified name."""
        ...

    def use(self) -> None:
        """Raise `InvalidHandle` if the entity was destroyed."""


class ServiceEvents:
    """Publishes the events of one service or client; the event types are those of `ServiceEventInfo`."""

    def __init__(self, entity: IntrospectedEntity, clock: Clock, qos_profile: QoSProfile) -> None:
        self.state = ServiceIntrospectionState.OFF
        self._event = entity.srv_type.Event
        self._clock = clock
        self._node: Any = entity._node  # has `create_publisher`: a type that this module, below it, cannot name
        self._publisher: Publisher = self._node.create_publisher(
            self._event, entity.service_name + EVENT_TOPIC, qos_profile
        )

    def report(
        self,
        kind: int,
        client: ClientEndpoint,
        number: int,
        *,
        request: Message | None = None,
        response: Message | None = None,
    ) -> None:
        """Publish one event; request and response are included only in the state CONTENTS."""
        if self.state == ServiceIntrospectionState.OFF:
            return
        event = self._event()
        info = event.info
        info.event_type = kind
        info.stamp = self._clock.now().to_msg()
        info.sequence_number = number
        info.client_gid[:] = list(client.gid)
        if self.state == ServiceIntrospectionState.CONTENTS:
            event.request = [] if request is None else [request]
            event.response = [] if response is None else [response]
        self._publisher.publish(event)

    def close(self) -> None:
        """Stop publishing."""
        self.state = ServiceIntrospectionState.OFF
        self._node.destroy_publisher(self._publisher)


def configure(entity: IntrospectedEntity, clock: Clock, qos_profile: QoSProfile, state: object) -> None:
    """Make a service or client publish its events, or stop it with OFF; raises `TypeError` for an invalid state."""
    _ = clock.handle, qos_profile.get_c_qos_profile  # an invalid clock or profile, such as a depth, fails as upstream
    if not isinstance(state, ServiceIntrospectionState):
        raise TypeError(f"configure_introspection(): incompatible function arguments: {state!r} is no state")
    entity.use()
    events = entity.events
    if events is None and state != ServiceIntrospectionState.OFF:
        events = entity.events = ServiceEvents(entity, clock, qos_profile)
    if events is not None:
        events.state = state
        if state == ServiceIntrospectionState.OFF:
            events.close()
            entity.events = None
