"""What services and clients have in common: each is one end of a service, whose activity can be published."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

from rclpy.impl.destroyable import Destroyable
from rclpy.impl.entity import Entity

if TYPE_CHECKING:
    from bot_console.runtime.rosidl.message import ServiceType
    from rclpy.callback_groups import CallbackGroup
    from rclpy.clock import Clock
    from rclpy.node_parts.base import NodeBase
    from rclpy.qos import QoSProfile
    from rclpy.service_introspection import ServiceEvents, ServiceIntrospectionState

End = TypeVar("End", bound="ServiceEnd")


class ServiceEnd(Entity):
    """A service or a client of a node; the node sets `endpoint` once it has the name."""

    endpoint: Any
    events: ServiceEvents | None = None
    """Publishes the entity's events while introspection is on; otherwise None."""

    def __init__(
        self,
        node: NodeBase,
        srv_type: ServiceType,
        srv_name: str,
        qos_profile: QoSProfile,
        callback_group: CallbackGroup,
    ) -> None:
        super().__init__(callback_group)
        self._node = node
        self.srv_type = srv_type
        self.srv_name = srv_name
        self.qos_profile = qos_profile

    @property
    def handle(self) -> Destroyable:
        """The entity's handle, as upstream has one."""
        return Destroyable(self, self.use)

    @property
    def service_name(self) -> str:
        """The fully qualified name after remapping."""
        self.use()
        return self.endpoint.name

    @property
    def logger_name(self) -> str:
        """The name of the node's logger."""
        return self._node.get_logger().name

    def pending(self) -> bool:
        """Whether a request or a response has arrived."""
        return bool(self.endpoint.queue) and not self.destroyed

    def configure_introspection(
        self, clock: Clock, service_event_qos_profile: QoSProfile, introspection_state: ServiceIntrospectionState
    ) -> None:
        """Publish the activity on a topic next to the service, or stop it with OFF.

        Raises `ValueError` for an invalid state.
        """
        from rclpy.service_introspection import configure

        configure(self, clock, service_event_qos_profile, introspection_state)

    def destroy(self) -> None:
        """Leave the graph and the executor."""
        self.destroyed = True
        self._node._ros_bus.remove(self.endpoint)
        self.detach()

    def __enter__(self: End) -> End:
        return self

    def __exit__(self, kind: object, error: object, trace: object) -> None:
        self.destroy()
