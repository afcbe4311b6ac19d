"""The requests of an action client that are waiting for a response."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

import threading
from typing import TYPE_CHECKING, Any

from bot_console.runtime.rmw.bus import Bus
from bot_console.runtime.rmw.endpoints import ClientEndpoint
from rclpy.task import Future

if TYPE_CHECKING:
    from rclpy.task import TaskExecutor
    from unique_identifier_msgs.msg import UUID


class PendingRequests:
    """Futures of the requests to one service, with the goal that each concerns."""

    def __init__(self, bus: Bus) -> None:
        self._bus = bus
        self._lock = threading.Lock()
        self._number = 0
        self._waiting: dict[int, tuple[Future[Any], UUID]] = {}

    def send(self, endpoint: ClientEndpoint, request: object, goal_id: UUID) -> Future[Any]:
        """Send a request and return a future that `settle` completes; a future that is cancelled before is dropped."""
        future: Future[Any] = Future()
        with self._lock:
            self._number += 1
            number = self._number
            self._waiting[number] = (future, goal_id)
        future._when_settled(lambda: self._discard(number))
        self._bus.request(endpoint, number, request)
        return future

    def subject(self, number: int) -> UUID | None:
        """Return the goal that a request concerns; None for a request that is not pending."""
        with self._lock:
            found = self._waiting.get(number)
        return None if found is None else found[1]

    def awaits(self, future: object) -> bool:
        """Whether the future belongs to a pending request."""
        with self._lock:
            return any(each is future for each, _ in self._waiting.values())

    def settle(self, number: int, result: object, executor: TaskExecutor | None) -> bool:
        """Complete a request; `executor` runs the done callbacks. Returns whether the request was pending."""
        found = self._forget(number)
        if found is None:
            return False
        found[0]._set_executor(executor)
        found[0].set_result(result)
        return True

    def _discard(self, number: int) -> None:
        self._forget(number)

    def _forget(self, number: int) -> tuple[Future[Any], UUID] | None:
        with self._lock:
            return self._waiting.pop(number, None)
