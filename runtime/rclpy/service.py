"""Service servers."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from bot_console.runtime.rmw.endpoints import ServiceEndpoint
from rclpy.impl.callback_order import SERVICE
from rclpy.impl.reexports import reexporting
from rclpy.service_end import ServiceEnd

if TYPE_CHECKING:
    from bot_console.runtime.rmw.endpoints import ClientEndpoint
    from bot_console.runtime.rosidl.message import Message, ServiceType
    from rclpy.callback_groups import CallbackGroup
    from rclpy.node_parts.base import NodeBase
    from rclpy.qos import QoSProfile


class Service(ServiceEnd):
    """Serves requests; see `Node.create_service`. The callback takes (request, response) and returns a response."""

    KIND = SERVICE
    endpoint: ServiceEndpoint

    def __init__(
        self,
        node: NodeBase,
        srv_type: ServiceType,
        srv_name: str,
        callback: Callable[..., Any],
        callback_group: CallbackGroup,
        qos_profile: QoSProfile,
    ) -> None:
        super().__init__(node, srv_type, srv_name, qos_profile, callback_group)
        self.callback = callback

    def run(self) -> object:
        """Take one request, run the callback and respond."""
        try:
            client, number, request = self.endpoint.queue.popleft()
        except IndexError:
            return None
        if self.endpoint.queue:
            self.notify()  # in a reentrant group the next callback may begin before this one has ended
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


__getattr__ = reexporting(
    __name__,
    "CallbackGroup Clock QoSProfile ServiceIntrospectionState SrvType SrvTypeRequest SrvTypeResponse",
)
