"""A goal as the callbacks of its server see it."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Protocol

from rclpy.action.goal_state import ACCEPTED, ACTIVE, CANCELING, GoalEvent, GoalStatus, next_status
from rclpy.task import Future

if TYPE_CHECKING:
    from action_msgs.msg import GoalInfo
    from bot_console.runtime.rosidl.message import Message, ServiceType
    from unique_identifier_msgs.msg import UUID


class GoalServer(Protocol):
    """What the handle of a goal needs of its action server."""

    @property
    def action_type(self) -> ServiceType:
        """The action's class."""
        ...

    def notify_execute(self, goal_handle: ServerGoalHandle, execute_callback: Callable[..., object] | None) -> None:
        """Schedule a callback for a goal."""

    def notify_goal_done(self) -> None:
        """Make the result of an ended goal expire after its time-out."""

    def _publish_status(self) -> None: ...

    def _publish_feedback(self, message: Message) -> None: ...

    def _now_ns(self) -> int: ...


class ServerGoalHandle:
    """An accepted goal: execute it, publish feedback, and end it by `succeed`, `abort` or `canceled`.

    These three raise `RCLError` in a state that does not allow them, such as `canceled` without a cancel request.
    """

    __module__ = "rclpy.action.server"  # as upstream, where a handle prints its address like any object

    def __init__(self, action_server: GoalServer, goal_info: GoalInfo, goal_request: Any) -> None:
        self._action_server = action_server
        self._goal_info = goal_info
        self._goal_request = goal_request
        self._status: int = ACCEPTED
        self._destroyed = False
        self._lock = threading.Lock()
        self._result_future: Future[Any] = Future()
        self._is_run_by_callback = False
        """Whether an execute callback is running, which will return the result."""
        self.terminal_ns: int | None = None
        """When the goal ended, by the node's clock (ns)."""

    def __eq__(self, other: object) -> bool:
        return self.goal_id == other.goal_id  # type: ignore[attr-defined] -- what is no such thing fails, as upstream

    def __ne__(self, other: object) -> bool:
        return self.goal_id != other.goal_id  # type: ignore[attr-defined] -- what is no such thing fails, as upstream

    __hash__ = None  # type: ignore[assignment] -- not hashable, as upstream

    @property
    def request(self) -> Any:
        """The goal, of the action's `Goal` class."""
        return self._goal_request

    @property
    def goal_id(self) -> UUID:
        """The goal's UUID."""
        return self._goal_info.goal_id

    @property
    def is_active(self) -> bool:
        """Whether the goal has not ended."""
        return not self._destroyed and self._status in ACTIVE

    @property
    def is_cancel_requested(self) -> bool:
        """Whether a cancel request was accepted."""
        return self.status == CANCELING

    @property
    def status(self) -> int:
        """One of the constants of `action_msgs/msg/GoalStatus`."""
        return GoalStatus.STATUS_UNKNOWN if self._destroyed else self._status

    def _update_state(self, event: GoalEvent) -> None:
        with self._lock:
            if self._destroyed:
                return
            self._status = next_status(self._status, event)
            self._action_server._publish_status()
            if self._status not in ACTIVE:
                self.terminal_ns = self._action_server._now_ns()
                self._action_server.notify_goal_done()

    def execute(self, execute_callback: Callable[..., object] | None = None) -> None:
        """Schedule the execute callback, the server's own by default, in the executor.

        A goal that is being cancelled keeps its state, so the callback must end it.
        """
        self.executing()
        self._action_server.notify_execute(self, execute_callback)

    def executing(self) -> None:
        """Mark the goal as executing, for a server without an execute callback; one being cancelled keeps its state."""
        if not self.is_cancel_requested:
            self._update_state(GoalEvent.EXECUTE)

    def publish_feedback(self, feedback: Message) -> None:
        """Send feedback to the clients; raises `TypeError` for anything but the action's `Feedback`."""
        if not isinstance(feedback, self._action_server.action_type.Feedback):
            raise TypeError
        with self._lock:
            if self._destroyed:
                return
            message = self._action_server.action_type.Impl.FeedbackMessage()
            message.goal_id = self.goal_id
            message.feedback = feedback
            self._action_server._publish_feedback(message)

    def succeed(self, response: Message | None = None) -> None:
        """Mark the goal as succeeded; `response` is its result, otherwise the return value of the execute callback."""
        self._end(GoalEvent.SUCCEED, response)

    def abort(self, response: Message | None = None) -> None:
        """Mark the goal as aborted by the server; `response` is its result."""
        self._end(GoalEvent.ABORT, response)

    def canceled(self, response: Message | None = None) -> None:
        """Mark the goal as cancelled at its client's request; `response` is its result."""
        self._end(GoalEvent.CANCELED, response)

    def _end(self, event: GoalEvent, response: Message | None) -> None:
        self._update_state(event)
        if response is not None or not self._is_run_by_callback:
            self._set_result(self._action_server.action_type.Result() if response is None else response)

    def _set_result(self, result: Message | None) -> None:
        """Send the result to clients that request it; only the first result counts."""
        if self._result_future.done():
            return
        response = self._action_server.action_type.Impl.GetResultService.Response()
        response.status = self.status
        response.result = result
        self._result_future.set_result(response)

    def destroy(self) -> None:
        """Release the goal; later calls do nothing."""
        with self._lock:
            self._destroyed = True
