"""The goals known to an action server."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

from typing import TYPE_CHECKING

from action_msgs.msg import GoalStatus, GoalStatusArray
from action_msgs.srv import CancelGoal
from rclpy.action.goal_state import is_cancelable
from rclpy.action.server_goal_handle import ServerGoalHandle
from rclpy.constants import S_TO_NS

if TYPE_CHECKING:
    from builtin_interfaces.msg import Time as TimeMsg

ANY_GOAL = bytes(16)


class Goals:
    """Goal handles by UUID in order of acceptance; results are kept for `timeout_ns` after the goal has ended."""

    def __init__(self, timeout_ns: int) -> None:
        self._timeout_ns = timeout_ns
        self._handles: dict[bytes, ServerGoalHandle] = {}
        self.next_expiry: int | None = None
        """When the first result may be forgotten, by the node's clock (ns)."""

    def __contains__(self, uuid: bytes) -> bool:
        return uuid in self._handles

    def get(self, uuid: bytes) -> ServerGoalHandle | None:
        """Return the handle of the goal with that UUID, or None."""
        return self._handles.get(uuid)

    def add(self, uuid: bytes, handle: ServerGoalHandle) -> None:
        """Add an accepted goal."""
        self._handles[uuid] = handle

    def status_array(self) -> GoalStatusArray:
        """Return the message of the status topic, with each goal that is still kept."""
        return GoalStatusArray(
            status_list=[
                GoalStatus(goal_info=each._goal_info, status=each._status) for each in list(self._handles.values())
            ]
        )

    def to_cancel(self, request: CancelGoal.Request) -> tuple[list[ServerGoalHandle], int]:
        """Return the goals that a cancel request selects, and the return code of the response.

        A UUID alone selects that goal; a time stamp selects all goals accepted up to then, plus the goal of a UUID; a
        request with neither selects all goals.
        """
        uuid, stamp = bytes(request.goal_info.goal_id.uuid), _ns(request.goal_info.stamp)
        none, terminated = CancelGoal.Response.ERROR_NONE, CancelGoal.Response.ERROR_GOAL_TERMINATED
        if uuid != ANY_GOAL and stamp == 0:
            handle = self._handles.get(uuid)
            if handle is None:
                return [], CancelGoal.Response.ERROR_UNKNOWN_GOAL_ID
            return ([handle], none) if is_cancelable(handle.status) else ([], terminated)
        every = uuid == ANY_GOAL and stamp == 0
        meant = [
            handle
            for each, handle in list(self._handles.items())
            if is_cancelable(handle.status) and (every or _ns(handle._goal_info.stamp) <= stamp or each == uuid)
        ]
        return meant, none

    def find_next_expiry(self) -> None:
        """Recompute `next_expiry` after a goal has ended or was removed."""
        ends = [each.terminal_ns for each in list(self._handles.values()) if each.terminal_ns is not None]
        self.next_expiry = min(ends) + self._timeout_ns + 1 if ends else None

    def expire(self, now_ns: int) -> None:
        """Remove the goals that ended more than the time-out ago."""
        for uuid, each in list(self._handles.items()):
            if each.terminal_ns is not None and now_ns - each.terminal_ns > self._timeout_ns:
                each.destroy()
                del self._handles[uuid]
        self.find_next_expiry()

    def destroy(self) -> None:
        """Destroy all goal handles."""
        for each in list(self._handles.values()):
            each.destroy()


def _ns(stamp: TimeMsg) -> int:
    return stamp.sec * S_TO_NS + stamp.nanosec
