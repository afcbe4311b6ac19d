"""Action servers."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

import functools
import threading
import traceback
from collections.abc import Callable
from enum import Enum
from typing import TYPE_CHECKING, Any

from action_msgs.msg import GoalInfo, GoalStatus
from bot_console.runtime.process import current
from rclpy._rclpy_pybind11 import RCLError
from rclpy.action.endpoints import ServerEndpoints, action_names
from rclpy.action.entity import ActionEntity, call, take
from rclpy.action.goal_state import GoalEvent
from rclpy.action.goals import Goals
from rclpy.action.server_goal_handle import ServerGoalHandle
from rclpy.constants import S_TO_NS
from rclpy.impl.logging_severity import LoggingSeverity
from rclpy.impl.reexports import reexporting
from rclpy.qos import QoSProfile, qos_profile_action_status_default, qos_profile_services_default
from rclpy.waitable import NumberOfEntities

if TYPE_CHECKING:
    from bot_console.runtime.rmw.endpoints import ClientEndpoint, Request
    from bot_console.runtime.rosidl.message import Message, ServiceType
    from rclpy.callback_groups import CallbackGroup
    from rclpy.impl.entity import EntityExecutor
    from rclpy.node import Node
    from rclpy.task import Future

RESULT_TIMEOUT_S = 900
"""How long a result is kept after the end of its goal."""
MARGIN_NS = 1_000_000
"""Margin for expiry (ns): the clock that wakes the executor is not the one by which results expire."""


class GoalResponse(Enum):
    """The possible answers of a goal callback."""

    REJECT = 1
    ACCEPT = 2


class CancelResponse(Enum):
    """The possible answers of a cancel callback."""

    REJECT = 1
    ACCEPT = 2


def default_handle_accepted_callback(goal_handle: ServerGoalHandle) -> None:
    """Execute the goal at once."""
    goal_handle.execute()


def default_goal_callback(goal_request: Message) -> GoalResponse:
    """Accept every goal."""
    return GoalResponse.ACCEPT


def default_cancel_callback(cancel_request: Any) -> CancelResponse:
    """Reject every cancel request."""
    return CancelResponse.REJECT


class ActionServer(ActionEntity):
    """Serves an action; callbacks may be functions or coroutine functions.

    `execute_callback(goal_handle)` returns the result; without it, `handle_accepted_callback` keeps a goal's handle for
    the code that will execute it. Results are kept for `result_timeout` (s) after the end of their goal. Raises
    `ValueError` for an invalid name, `TypeError` for an execute callback that is not callable.
    """

    def __init__(
        self,
        node: Node,
        action_type: ServiceType,
        action_name: str,
        execute_callback: Callable[..., object] | None = None,
        *,
        callback_group: CallbackGroup | None = None,
        goal_callback: Callable[..., object] = default_goal_callback,
        handle_accepted_callback: Callable[..., object] = default_handle_accepted_callback,
        cancel_callback: Callable[..., object] = default_cancel_callback,
        goal_service_qos_profile: QoSProfile = qos_profile_services_default,
        result_service_qos_profile: QoSProfile = qos_profile_services_default,
        cancel_service_qos_profile: QoSProfile = qos_profile_services_default,
        feedback_pub_qos_profile: QoSProfile | None = None,
        status_pub_qos_profile: QoSProfile = qos_profile_action_status_default,
        result_timeout: float = RESULT_TIMEOUT_S,
    ) -> None:
        super().__init__(node, action_type, callback_group)
        self._lock = threading.Lock()
        self.register_handle_accepted_callback(handle_accepted_callback)
        self.register_goal_callback(goal_callback)
        self.register_cancel_callback(cancel_callback)
        self._execute_callback: Callable[..., object] | None = None
        if execute_callback is not None:
            self.register_execute_callback(execute_callback)
        self._check("server")
        names = action_names(node, action_name, "server")
        kept_ns = int(result_timeout * S_TO_NS)
        if kept_ns < 0:
            raise ValueError("Failed to create action server: timer period must be non-negative")
        self._goals = Goals(kept_ns)
        self._logger = node.get_logger().get_child("action_server")
        if execute_callback is None and handle_accepted_callback in (None, default_handle_accepted_callback):
            self._logger.warning("Not handling nor executing the goal, this server will do nothing")
        self._clock = node.get_clock()
        feedback_qos = feedback_pub_qos_profile or QoSProfile(depth=10)
        self._endpoints = ServerEndpoints(
            node, action_type.Impl, names, self.notify, feedback_qos, status_pub_qos_profile
        )
        self._clock._add_timer(self)
        self._join()

    @property
    def action_type(self) -> ServiceType:
        """The action's class."""
        return self._action_type

    def register_handle_accepted_callback(self, handle_accepted_callback: Callable[..., object] | None) -> None:
        """Set the callback that gets the handle of each accepted goal; None executes goals at once."""
        self._handle_accepted_callback = handle_accepted_callback or default_handle_accepted_callback

    def register_goal_callback(self, goal_callback: Callable[..., object] | None) -> None:
        """Set the callback that accepts or rejects goals; None accepts all."""
        self._goal_callback = goal_callback or default_goal_callback

    def register_cancel_callback(self, cancel_callback: Callable[..., object] | None) -> None:
        """Set the callback that accepts or rejects cancel requests; None rejects all."""
        self._cancel_callback = cancel_callback or default_cancel_callback

    def register_execute_callback(self, execute_callback: Callable[..., object]) -> None:
        """Set the callback that executes goals; raises `TypeError` if it is not callable."""
        if not callable(execute_callback):
            raise TypeError("Failed to register goal execution callback: not callable")
        self._execute_callback = execute_callback

    def get_num_entities(self) -> NumberOfEntities:
        """Return the number of entities: a timer and three services."""
        return NumberOfEntities(0, 0, 1, 0, 3)

    def pending(self) -> bool:
        """Whether a request has arrived or a result has expired."""
        return super().pending() or (not self.destroyed and self._expired())

    def run(self) -> object:
        """Take and serve one request of each kind."""
        ends = self._endpoints
        return self._serve(take(ends.goal.queue), take(ends.cancel.queue), take(ends.result.queue), self._expired())

    async def _serve(self, goal: Request | None, cancel: Request | None, result: Request | None, expired: bool) -> None:
        if goal is not None:
            await self._serve_goal(*goal)
        if cancel is not None:
            await self._serve_cancel(*cancel)
        if result is not None:
            self._serve_result(*result)
        if expired:
            self._goals.expire(self._now_ns())
            self.arm()

    async def _serve_goal(self, client: ClientEndpoint, number: int, request: Any) -> None:
        uuid = bytes(request.goal_id.uuid)
        handle = await self._accept_goal(request, uuid)
        response = self._action_type.Impl.SendGoalService.Response()
        response.accepted = handle is not None
        if handle is not None:
            response.stamp = handle._goal_info.stamp
        self._respond("goal", client, number, response)
        if handle is None:
            self._debug("New goal rejected: {}", request.goal_id.uuid)
            return
        self._debug("New goal accepted: {}", request.goal_id.uuid)
        self._publish_status()
        await call(self._handle_accepted_callback, handle)

    async def _accept_goal(self, request: Any, uuid: bytes) -> ServerGoalHandle | None:
        """Return the handle of a goal that the goal callback accepts, else None; a known UUID is rejected."""
        self._debug("New goal request with ID: {}", request.goal_id.uuid)
        if uuid in self._goals:
            return None
        response = await call(self._goal_callback, request.goal)
        if not isinstance(response, GoalResponse):
            self._logger.warning("Goal request callback did not return a GoalResponse type. Rejecting goal.")
            return None
        if response is not GoalResponse.ACCEPT or self.destroyed:
            return None
        info = GoalInfo(goal_id=request.goal_id, stamp=self._clock.now().to_msg())
        with self._lock:
            # An asynchronous goal callback may have accepted the same goal meanwhile.
            if uuid in self._goals:
                return None
            handle = ServerGoalHandle(self, info, request.goal)
            self._goals.add(uuid, handle)
        return handle

    async def _serve_cancel(self, client: ClientEndpoint, number: int, request: Any) -> None:
        self._debug("Cancel request received: {}", request)
        handles, code = self._goals.to_cancel(request)
        canceling: list[GoalInfo] = []
        for handle in handles:
            if await call(self._cancel_callback, handle) is not CancelResponse.ACCEPT:
                continue
            try:
                handle._update_state(GoalEvent.CANCEL_GOAL)
            except RCLError as error:
                self._debug("Failed to cancel goal with ID {}: {}", handle.goal_id.uuid, error)
                continue
            canceling.append(handle._goal_info)
        response = self._action_type.Impl.CancelGoalService.Response()
        response.return_code = code
        response.goals_canceling = canceling
        self._respond("cancel", client, number, response)

    def _serve_result(self, client: ClientEndpoint, number: int, request: Any) -> None:
        self._debug("Result request received for goal with ID: {}", request.goal_id.uuid)
        handle = self._goals.get(bytes(request.goal_id.uuid))
        if handle is None:
            self._debug("Sending result response for unknown goal ID: {}", request.goal_id.uuid)
            response = self._action_type.Impl.GetResultService.Response()
            response.status = GoalStatus.STATUS_UNKNOWN
            self._node._ros_bus.respond(client, number, response)
            return
        handle._result_future._set_executor(self.sink)
        handle._result_future.add_done_callback(functools.partial(self._send_result, client, number))

    def _send_result(self, client: ClientEndpoint, number: int, future: Future[Any]) -> None:
        self._respond("result", client, number, future.result())

    def _respond(self, kind: str, client: ClientEndpoint, number: int, response: object) -> None:
        """Send a response, unless the server was destroyed during the user's coroutine that it waited for."""
        if self.destroyed:
            self._logger.warning(f"Failed to send {kind} response (the action server was destroyed)")
        else:
            self._node._ros_bus.respond(client, number, response)

    def notify_execute(self, goal_handle: ServerGoalHandle, execute_callback: Callable[..., object] | None) -> None:
        """Schedule a goal's execution in the node's executor, by `execute_callback` or the server's own, if any."""
        callback = self._execute_callback if execute_callback is None else execute_callback
        if callback is None:
            return
        goal_handle._is_run_by_callback = True
        executor: Any = self._node.executor  # without an executor it fails, as upstream
        executor.create_task(self._execute_goal, callback, goal_handle)

    async def _execute_goal(self, callback: Callable[..., object], handle: ServerGoalHandle) -> None:
        uuid = handle.goal_id.uuid
        self._debug("Executing goal with ID {}", uuid)
        try:
            result = await call(callback, handle)
        except Exception as error:  # boundary of a user callback: the client gets an empty result, the log the reason
            result = self._action_type.Result()
            self._logger.error(f"Error raised in execute callback: {error}")
            traceback.print_exc()
        if not isinstance(result, self._action_type.Result) and not handle._result_future.done():
            self._warn_of_result(callback, result)
        if handle.is_active:
            self._logger.warning(f"Goal state not set, assuming aborted. Goal ID: {uuid}")
            handle.abort()
        self._debug("Goal with ID {} finished with state {}", uuid, handle.status)
        handle._set_result(result)

    def _warn_of_result(self, callback: Callable[..., object], result: object) -> None:
        """Warn of a result with the wrong type; upstream fails only at a request for it, and names no callback."""
        code = getattr(callback, "__code__", None)
        place = f" ({code.co_filename}:{code.co_firstlineno})" if code else ""
        self._logger.warning(
            f"The execute callback{place} returned {type(result).__name__} where {self._action_type.__name__}.Result "
            "is needed; sending the result will fail. Return a result at each end of the callback."
        )

    def notify_goal_done(self) -> None:
        """Make the result of an ended goal expire after its time-out."""
        self._goals.find_next_expiry()
        self.arm()

    def _publish_status(self) -> None:
        self._may_publish("Failed get goal status array")
        self._endpoints.status.publish(self._goals.status_array())

    def _publish_feedback(self, message: Message) -> None:
        self._may_publish("Failed to publish feedback with an action server")
        self._endpoints.feedback.publish(message)

    def _may_publish(self, refused: str) -> None:
        self.use()
        if self._node.context.ended:
            current().deliver_signals()  # as in a publisher: an interrupt takes precedence over this error
            raise RCLError(f"{refused}: feedback publisher is invalid")

    def _debug(self, text: str, *values: object) -> None:
        if self._logger.is_enabled_for(LoggingSeverity.DEBUG):
            self._logger.debug(text.format(*values))

    def _now_ns(self) -> int:
        return self._clock._now_ns()

    def _expired(self) -> bool:
        due = self._goals.next_expiry
        return due is not None and self._now_ns() >= due

    def arm(self) -> None:
        """Set when the executor expires the next result; called again at each jump of simulated time."""
        due, sink = self._goals.next_expiry, self.sink
        if due is None or sink is None or self.destroyed:
            return
        deadline = self._clock._steady_deadline(due)
        if deadline is not None:
            sink.arm(self, deadline + MARGIN_NS)
        elif self.pending():
            self.notify()

    def attach(self, sink: EntityExecutor, node_order: int) -> None:
        """Attach the server to an executor."""
        super().attach(sink, node_order)
        self.arm()

    def time_jumped(self, backward: bool) -> None:
        """Re-arm after a jump of the node's clock."""
        self.arm()

    def destroy(self) -> None:
        """Destroy the server and drop its goals."""
        if self.destroyed:
            return
        self._goals.destroy()
        self._clock._remove_timer(self)
        super().destroy()


__getattr__ = reexporting(__name__, "Future Task Waitable await_or_execute check_for_type_support")
