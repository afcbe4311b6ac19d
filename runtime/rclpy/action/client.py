"""Action clients."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

import threading
import uuid
import weakref
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from action_msgs.msg import GoalStatus as GoalStatus  # programs import it from this module
from action_msgs.srv import CancelGoal
from bot_console.runtime.rmw.endpoints import take_queued
from rclpy.action.client_goal_handle import ClientGoalHandle
from rclpy.action.endpoints import ClientEndpoints, action_names
from rclpy.action.entity import ActionEntity, call, take
from rclpy.action.goal_state import TERMINAL
from rclpy.action.pending_requests import PendingRequests
from rclpy.deadlock import wait_until_settled
from rclpy.impl.graph_wait import require_valid, wait_until_there
from rclpy.impl.reexports import reexporting
from rclpy.qos import QoSProfile, qos_profile_action_status_default, qos_profile_services_default
from rclpy.task import Future
from rclpy.waitable import NumberOfEntities
from unique_identifier_msgs.msg import UUID

if TYPE_CHECKING:
    from action_msgs.msg import GoalStatusArray
    from bot_console.runtime.rmw.endpoints import Arrival, Response
    from bot_console.runtime.rosidl.message import Message, ServiceType
    from rclpy.action.client_goal_handle import GoalResponse
    from rclpy.callback_groups import CallbackGroup
    from rclpy.node import Node


class ActionClient(ActionEntity):
    """Sends goals to an action server; raises `ValueError` for an invalid name."""

    def __init__(
        self,
        node: Node,
        action_type: ServiceType,
        action_name: str,
        *,
        callback_group: CallbackGroup | None = None,
        goal_service_qos_profile: QoSProfile = qos_profile_services_default,
        result_service_qos_profile: QoSProfile = qos_profile_services_default,
        cancel_service_qos_profile: QoSProfile = qos_profile_services_default,
        feedback_sub_qos_profile: QoSProfile | None = None,
        status_sub_qos_profile: QoSProfile = qos_profile_action_status_default,
    ) -> None:
        super().__init__(node, action_type, callback_group)
        self._check("client")
        names = action_names(node, action_name, "client")
        self._action_name = action_name
        self._logger = node.get_logger().get_child("action_client")
        self._lock = threading.Lock()
        self._goal_handles: dict[bytes, weakref.ref[ClientGoalHandle]] = {}
        self._feedback_callbacks: dict[bytes, Callable[..., object]] = {}
        self._goals = PendingRequests(self._node._ros_bus)
        self._cancels = PendingRequests(self._node._ros_bus)
        self._results = PendingRequests(self._node._ros_bus)
        feedback_qos = feedback_sub_qos_profile or QoSProfile(depth=10)
        self._endpoints = ClientEndpoints(
            node, action_type.Impl, names, self.notify, feedback_qos, status_sub_qos_profile
        )
        self._join()

    def get_num_entities(self) -> NumberOfEntities:
        """Return the number of entities: two subscriptions and three clients."""
        return NumberOfEntities(2, 0, 0, 3, 0)

    def run(self) -> object:
        """Take one response of each kind, one feedback and one status, and dispatch them.

        A result is preceded by all the feedback that arrived before it, as feedback is not delivered afterwards.
        """
        ends = self._endpoints
        responses = (take(ends.goal.queue), take(ends.cancel.queue), take(ends.result.queue))
        feedback = [take(ends.feedback.queue) for _ in range(len(ends.feedback.queue) if responses[2] else 1)]
        return self._receive(*responses, feedback, take(ends.status.queue))

    async def _receive(
        self,
        goal: Response | None,
        cancel: Response | None,
        result: Response | None,
        feedback: list[Arrival | None],
        status: Arrival | None,
    ) -> None:
        handle = None if goal is None else self._goal_handle(*goal)
        statuses = None if status is None else take_queued(status[0])
        if statuses is not None:
            self._receive_status(statuses)  # before the goal's future is settled: another thread may run its callback
        if goal is not None and handle is not None:
            self._goals.settle(goal[0], handle, self.sink)
        if cancel is not None:
            self._settle(self._cancels, "cancel", *cancel)
        for each in feedback:
            await self._receive_feedback(each)
        if result is not None:
            self._settle(self._results, "result", *result)

    async def _receive_feedback(self, entry: Arrival | None) -> None:
        message = None if entry is None else take_queued(entry[0])
        callback = None if message is None else self._feedback_callbacks.get(bytes(message.goal_id.uuid))
        if callback is not None:
            await call(callback, message)

    def _goal_handle(self, number: int, response: GoalResponse) -> ClientGoalHandle | None:
        """Return the handle of an answered goal; None for a response that nothing waits for."""
        goal_id = self._goals.subject(number)
        if goal_id is None:
            self._unexpected("goal")
            return None
        handle = ClientGoalHandle(self, goal_id, response)
        key = bytes(goal_id.uuid)
        if handle.accepted:
            if key in self._goal_handles:
                raise RuntimeError(f"Two goals were accepted with the same ID ({handle})")
            self._goal_handles[key] = weakref.ref(handle)
        else:
            self._feedback_callbacks.pop(key, None)
        return handle

    def _settle(self, requests: PendingRequests, kind: str, number: int, response: object) -> None:
        if not requests.settle(number, response, self.sink):
            self._unexpected(kind)

    def _unexpected(self, kind: str) -> None:
        self._logger.warning(
            f"Ignoring unexpected {kind} response. There may be more than one action server for the action "
            f"'{self._action_name}'"
        )

    def _receive_status(self, message: GoalStatusArray) -> None:
        for each in message.status_list:
            key = bytes(each.goal_info.goal_id.uuid)
            reference = self._goal_handles.get(key)
            if reference is None:
                continue
            handle = reference()
            if handle is not None:
                handle._status = each.status
            if handle is None or each.status in TERMINAL:
                del self._goal_handles[key]

    def send_goal(self, goal: Message, **kwargs: Any) -> Any:
        """Send a goal and wait for its result; another thread has to spin.

        Raises `ROSInterruptException` when the context is shut down meanwhile.
        """
        return self._get_result(self._wait(self.send_goal_async(goal, **kwargs)))

    def send_goal_async(
        self, goal: Message, feedback_callback: Callable[..., object] | None = None, goal_uuid: UUID | None = None
    ) -> Future[Any]:
        """Send a goal; the future gets a `ClientGoalHandle` when the server has accepted or rejected it.

        Raises `TypeError` for anything but the action's `Goal`.
        """
        if not isinstance(goal, self._action_type.Goal):
            raise TypeError
        self.use()
        request = self._action_type.Impl.SendGoalService.Request()
        request.goal_id = UUID(uuid=list(uuid.uuid4().bytes)) if goal_uuid is None else goal_uuid
        request.goal = goal
        if feedback_callback is not None:
            self._feedback_callbacks[bytes(request.goal_id.uuid)] = feedback_callback
        return self._goals.send(self._endpoints.goal, request, request.goal_id)

    def _cancel_goal(self, goal_handle: ClientGoalHandle) -> Any:
        return self._wait(self._cancel_goal_async(goal_handle))

    def _cancel_goal_async(self, goal_handle: ClientGoalHandle) -> Future[Any]:
        self._check_handle(goal_handle)
        request = CancelGoal.Request()
        request.goal_info.goal_id = goal_handle.goal_id
        return self._cancels.send(self._endpoints.cancel, request, goal_handle.goal_id)

    def _get_result(self, goal_handle: ClientGoalHandle) -> Any:
        return self._wait(self._get_result_async(goal_handle))

    def _get_result_async(self, goal_handle: ClientGoalHandle) -> Future[Any]:
        self._check_handle(goal_handle)
        request = self._action_type.Impl.GetResultService.Request()
        request.goal_id = goal_handle.goal_id
        future = self._results.send(self._endpoints.result, request, goal_handle.goal_id)
        key = bytes(goal_handle.goal_id.uuid)
        future.add_done_callback(lambda _: self._feedback_callbacks.pop(key, None))
        return future

    def _check_handle(self, goal_handle: object) -> None:
        if not isinstance(goal_handle, ClientGoalHandle):
            raise TypeError(f"Expected type ClientGoalHandle but received {type(goal_handle)}")
        self.use()

    def awaits(self, future: object) -> bool:
        """Whether the future belongs to a request that has not been answered yet."""
        return any(each.awaits(future) for each in (self._goals, self._cancels, self._results))

    def server_is_ready(self) -> bool:
        """Whether a server is available; raises `RCLError` after a shutdown of the context."""
        self.use()
        require_valid(self._node.context, "Failed to check if action server is available")
        return self._endpoints.server_is_there()

    def wait_for_server(self, timeout_sec: float | None = None) -> bool:
        """Block until a server is available; False after the time-out (s). Raises `RCLError` once the context ends."""
        return wait_until_there(self._node, self.server_is_ready, timeout_sec)

    def _wait(self, future: Future[Any]) -> Any:
        wait_until_settled(future, self, self._node, f"a call of action {self._action_name}")
        return future.result()


__getattr__ = reexporting(__name__, "Waitable check_for_type_support")
