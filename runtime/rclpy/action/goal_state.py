"""The states of a goal, and the events that change them."""

from __future__ import annotations

from enum import Enum

from action_msgs.msg import GoalStatus
from rclpy._rclpy_pybind11 import RCLError

ACCEPTED = GoalStatus.STATUS_ACCEPTED
EXECUTING = GoalStatus.STATUS_EXECUTING
CANCELING = GoalStatus.STATUS_CANCELING
SUCCEEDED = GoalStatus.STATUS_SUCCEEDED
CANCELED = GoalStatus.STATUS_CANCELED
ABORTED = GoalStatus.STATUS_ABORTED

ACTIVE = frozenset((ACCEPTED, EXECUTING, CANCELING))
TERMINAL = frozenset((SUCCEEDED, CANCELED, ABORTED))


class GoalEvent(Enum):
    """The events in the life of a goal."""

    EXECUTE = 0
    CANCEL_GOAL = 1
    SUCCEED = 2
    ABORT = 3
    CANCELED = 4


_NEXT = {
    (ACCEPTED, GoalEvent.EXECUTE): EXECUTING,
    (ACCEPTED, GoalEvent.CANCEL_GOAL): CANCELING,
    (EXECUTING, GoalEvent.CANCEL_GOAL): CANCELING,
    (EXECUTING, GoalEvent.SUCCEED): SUCCEEDED,
    (EXECUTING, GoalEvent.ABORT): ABORTED,
    (CANCELING, GoalEvent.SUCCEED): SUCCEEDED,
    (CANCELING, GoalEvent.ABORT): ABORTED,
    (CANCELING, GoalEvent.CANCELED): CANCELED,
}
_NAMES = ("UNKNOWN", "ACCEPTED", "EXECUTING", "CANCELING", "SUCCEEDED", "CANCELED", "ABORTED")


def next_status(status: int, event: GoalEvent) -> int:
    """Return the status after an event; raises `RCLError` for an event that is impossible in the given status."""
    try:
        return _NEXT[status, event]
    except KeyError:
        raise RCLError(
            "Failed to update goal state: goal_handle attempted invalid transition "
            f"from state {_NAMES[status]} with event {event.name}"
        ) from None


def is_cancelable(status: int) -> bool:
    """Whether a cancel request can still be accepted."""
    return (status, GoalEvent.CANCEL_GOAL) in _NEXT
