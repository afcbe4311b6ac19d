"""Service servers."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from bot_console.runtime.rmw.endpoints import ServiceEndpoint
from rclpy.impl.destroyable import Destroyable
from rclpy.impl.entity import SERVICE, Entity
from rclpy.impl.reexports import reexporting


class Service(Entity):
    """Serves requests; made by `Node.create_service`. The callback takes (request, response) and returns a response."""

    KIND = SERVICE
    events: Any = None
    """Publishes the service's events while introspection is on."""

    def __init__(
        self,
        node: Any,
        srv_type: Any,
        srv_name: str,
        callback: Callable[..., Any],
        callback_group: Any,
        qos_profile: Any,
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

    def run(self) -> Any:
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

    async def _respond_later(self, client: Any, number: int, request: Any) -> None:
        self.send_response(await self._callback(request, self.srv_type.Response()), (client, number))

    def send_response(self, response: Any, header: Any) -> None:
        """Send a response; raises `TypeError` for anything but a response of the service."""
        if not isinstance(response, self.srv_type.Response):
            raise TypeError
        self.use()
        self._node._ros_bus.respond(header[0], header[1], response)
        if self.events is not None:
            self.events.report(2, header[0], header[1], response=response)

    def configure_introspection(self, clock: Any, service_event_qos_profile: Any, introspection_state: Any) -> None:
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

    def __exit__(self, kind: Any, error: Any, trace: Any) -> None:
        self.destroy()


__getattr__ = reexporting(
    __name__,
    "CallbackGroup Clock QoSProfile ServiceIntrospectionState SrvType SrvTypeRequest SrvTypeResponse",
)
