"""A goal as its client sees it."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

from action_msgs.msg import GoalStatus
from rclpy.task import Future

if TYPE_CHECKING:
    from builtin_interfaces.msg import Time as TimeMsg
    from unique_identifier_msgs.msg import UUID


class GoalClient(Protocol):
    """What the handle of a goal needs of its action client."""

    def _cancel_goal(self, goal_handle: ClientGoalHandle) -> Any: ...

    def _cancel_goal_async(self, goal_handle: ClientGoalHandle) -> Future[Any]: ...

    def _get_result(self, goal_handle: ClientGoalHandle) -> Any: ...

    def _get_result_async(self, goal_handle: ClientGoalHandle) -> Future[Any]: ...


class GoalResponse(Protocol):
    """The response of `send_goal`."""

    @property
    def accepted(self) -> bool:
        """Whether the goal was accepted."""
        ...

    @property
    def stamp(self) -> TimeMsg:
        """When the goal was accepted."""
        ...


class ClientGoalHandle:
    """A goal that was sent and answered; `status` follows the server's status topic."""

    __module__ = "rclpy.action.client"  # as upstream, where a handle prints its address like any object

    def __init__(self, action_client: GoalClient, goal_id: UUID, goal_response: GoalResponse) -> None:
        self._action_client = action_client
        self._goal_id = goal_id
        self._goal_response = goal_response
        self._status: int = GoalStatus.STATUS_UNKNOWN

    def __eq__(self, other: object) -> bool:
        return self._goal_id == other.goal_id  # type: ignore[attr-defined] -- what is no such thing fails, as upstream

    def __ne__(self, other: object) -> bool:
        return self._goal_id != other.goal_id  # type: ignore[attr-defined] -- what is no such thing fails, as upstream

    __hash__ = None  # type: ignore[assignment] -- not hashable, as upstream

    def __repr__(self) -> str:
        return f"ClientGoalHandle <id={self.goal_id.uuid}, accepted={self.accepted}, status={self.status}>"

    @property
    def goal_id(self) -> UUID:
        """The goal's UUID."""
        return self._goal_id

    @property
    def stamp(self) -> TimeMsg:
        """When the server accepted the goal."""
        return self._goal_response.stamp

    @property
    def accepted(self) -> bool:
        """Whether the server accepted the goal."""
        return self._goal_response.accepted

    @property
    def status(self) -> int:
        """One of the constants of `action_msgs/msg/GoalStatus`."""
        return self._status

    def cancel_goal(self) -> Any:
        """Request cancellation and wait for the response; another thread has to spin."""
        return self._action_client._cancel_goal(self)

    def cancel_goal_async(self) -> Future[Any]:
        """Request cancellation; the future gets the `CancelGoal` response."""
        return self._action_client._cancel_goal_async(self)

    def get_result(self) -> Any:
        """Request the result and wait for it; another thread has to spin."""
        return self._action_client._get_result(self)

    def get_result_async(self) -> Future[Any]:
        """Request the result; the future gets a response with `status` and `result`."""
        return self._action_client._get_result_async(self)
