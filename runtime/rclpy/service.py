"""Service servers."""

# pyright: reportPrivateUsage=false
# The modules of rclpy are one library: what its users are not to touch has an underscore, as upstream.

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from bot_console.runtime.rmw.endpoints import ServiceEndpoint
from rclpy.impl.callback_order import SERVICE
from rclpy.impl.destroyable import Destroyable
from rclpy.impl.entity import Entity
from rclpy.impl.reexports import reexporting

if TYPE_CHECKING:
    from types import TracebackType

    from bot_console.runtime.rmw.endpoints import ClientEndpoint
    from bot_console.runtime.rosidl.message import Message, ServiceType
    from rclpy.callback_groups import CallbackGroup
    from rclpy.clock import Clock
    from rclpy.node_parts.base import NodeBase
    from rclpy.qos import QoSProfile
    from rclpy.service_introspection import ServiceEvents, ServiceIntrospectionState


class Service(Entity):
    """Serves requests; made by `Node.create_service`. The callback takes (request, response) and returns a response."""

    KIND = SERVICE
    events: ServiceEvents | None = None
    """Publishes the service's events while introspection is on."""

    def __init__(
        self,
        node: NodeBase,
        srv_type: ServiceType,
        srv_name: str,
        callback: Callable[..., Any],
        callback_group: CallbackGroup,
        qos_profile: QoSProfile,
    ) -> None:
        super().__init__(callback_group)
        self._node = node
        self.srv_type = srv_type
        self.srv_name = srv_name
        self.callback = callback
        self.qos_profile = qos_profile
        self.endpoint: ServiceEndpoint

    @property
    def handle(self) -> Destroyable:
        """The service's handle, as upstream's service has one."""
        return Destroyable(self, self.use)

    @property
    def service_name(self) -> str:
        """The fully qualified name, remapped."""
        self.use()
        return self.endpoint.name

    @property
    def logger_name(self) -> str:
        """The name of the node's logger."""
        return self._node.get_logger().name

    def pending(self) -> bool:
        """Whether a request has arrived."""
        return bool(self.endpoint.queue) and not self.destroyed

    def run(self) -> object:
        """Take one request, run the callback and respond."""
        try:
            client, number, request = self.endpoint.queue.popleft()
        except IndexError:
            return None
        if self.endpoint.queue:
            self.notify()  # in a reentrant group the next one may begin before this one has ended
        if self.events is not None:
            self.events.report(1, client, number, request=request)
        if self._is_async:
            return self._respond_later(client, number, request)
        self.send_response(self._callback(request, self.srv_type.Response()), (client, number))
        return None

    async def _respond_later(self, client: ClientEndpoint, number: int, request: Message) -> None:
        self.send_response(await self._callback(request, self.srv_type.Response()), (client, number))

    def send_response(self, response: Message, header: tuple[ClientEndpoint, int]) -> None:
        """Send a response; raises `TypeError` for anything but a response of the service."""
        if not isinstance(response, self.srv_type.Response):
            raise TypeError
        self.use()
        self._node._ros_bus.respond(header[0], header[1], response)
        if self.events is not None:
            self.events.report(2, header[0], header[1], response=response)

    def configure_introspection(
        self, clock: Clock, service_event_qos_profile: QoSProfile, introspection_state: ServiceIntrospectionState
    ) -> None:
        """Publish the service's activity on a topic next to it."""
        from rclpy.service_introspection import configure

        configure(self, clock, service_event_qos_profile, introspection_state)

    def destroy(self) -> None:
        """Destroy the service."""
        self.destroyed = True
        self._node._ros_bus.remove(self.endpoint)
        self.detach()

    def __enter__(self) -> Service:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.destroy()


__getattr__ = reexporting(
    __name__,
    "CallbackGroup Clock QoSProfile ServiceIntrospectionState SrvType SrvTypeRequest SrvTypeResponse",
)
