"""Service clients."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

import threading
from functools import partial
from typing import TYPE_CHECKING, Any

from bot_console.runtime.process import current
from bot_console.runtime.rmw.endpoints import ClientEndpoint
from rclpy.constants import S_TO_NS
from rclpy.deadlock import wait_until_settled
from rclpy.impl.callback_order import CLIENT
from rclpy.impl.graph_wait import require_valid, wait_until_there
from rclpy.impl.reexports import reexporting
from rclpy.service_end import ServiceEnd
from rclpy.task import Future

if TYPE_CHECKING:
    from bot_console.runtime.rosidl.message import Message, ServiceType
    from rclpy.callback_groups import CallbackGroup
    from rclpy.node_parts.base import NodeBase
    from rclpy.qos import QoSProfile


class Client(ServiceEnd):
    """Calls a service; made by `Node.create_client`."""

    KIND = CLIENT
    endpoint: ClientEndpoint

    def __init__(
        self,
        node: NodeBase,
        srv_type: ServiceType,
        srv_name: str,
        qos_profile: QoSProfile,
        callback_group: CallbackGroup,
    ) -> None:
        super().__init__(node, srv_type, srv_name, qos_profile, callback_group)
        self.context = node.context
        self._pending_requests: dict[int, Future[Any]] = {}
        self._number = 0
        self._lock = threading.Lock()

    def call(self, request: Message, timeout_sec: float | None = None) -> Any:
        """Send a request and wait for the response, received by another thread; None after the time-out (s).

        Without a time-out it raises `ROSInterruptException` when the context is shut down.
        """
        if not isinstance(request, self.srv_type.Request):
            raise TypeError
        future = self.call_async(request)
        if not future.done():
            clock = current().clock
            deadline = None if timeout_sec is None else clock.steady_ns() + int(timeout_sec * float(S_TO_NS))
            try:
                wait_until_settled(future, self, self._node, f"a call of {self.endpoint.name}", deadline)
            finally:
                if not future.done():
                    self.remove_pending_request(future)
            if not future.done():
                return None
        if future.exception() is not None:
            raise future.exception()  # type: ignore[misc] -- there is one here
        return future.result()

    def call_async(self, request: Message) -> Future[Any]:
        """Send a request; the future is done when the response has arrived and an executor has taken it."""
        if not isinstance(request, self.srv_type.Request):
            raise TypeError
        self.use()
        with self._lock:
            self._number += 1
            number = self._number
            future: Future[Any] = Future()
            self._pending_requests[number] = future
        future._when_settled(partial(self._pending_requests.pop, number, None))
        self._node._ros_bus.request(self.endpoint, number, request)
        if self.events is not None:
            self.events.report(0, self.endpoint, number, request=request)
        return future

    def get_pending_request(self, sequence_number: int) -> Future[Any]:
        """Return the future of a request; raises `KeyError` for one that is not pending."""
        return self._pending_requests[sequence_number]

    def remove_pending_request(self, future: Future[Any]) -> None:
        """Stop waiting for a response; it is dropped when it arrives."""
        with self._lock:
            for number, each in list(self._pending_requests.items()):
                if each is future:
                    del self._pending_requests[number]
                    return

    def awaits(self, future: object) -> bool:
        """Whether the future belongs to a request that has not been answered yet."""
        return future in tuple(self._pending_requests.values())

    def run(self) -> object:
        """Take one response and complete its future."""
        try:
            number, response = self.endpoint.queue.popleft()
        except IndexError:
            return None
        if self.events is not None:
            self.events.report(3, self.endpoint, number, response=response)
        future = self._pending_requests.pop(number, None)
        if future is not None:
            future._set_executor(self.sink)
            future.set_result(response)
        return None

    def service_is_ready(self) -> bool:
        """Whether a server is available; raises `RCLError` after a shutdown of the context."""
        self.use()
        require_valid(self._node.context, "failed to check service availability")
        return self._node._ros_bus.has_server(self.endpoint)

    def wait_for_service(self, timeout_sec: float | None = None) -> bool:
        """Block until a server is available; False after the time-out (s). Raises `RCLError` once the context ends."""
        return wait_until_there(self._node, self.service_is_ready, timeout_sec)


__getattr__ = reexporting(
    __name__,
    "CallbackGroup Clock Context QoSProfile ServiceIntrospectionState SrvType SrvTypeRequest SrvTypeResponse",
)
