"""Transitions of a goal's state by events."""

from __future__ import annotations

import pytest
from action_msgs.msg import GoalStatus
from rclpy._rclpy_pybind11 import RCLError
from rclpy.action.goal_state import GoalEvent, is_cancelable, next_status

ALLOWED = {
    ("ACCEPTED", "EXECUTE"): "EXECUTING",
    ("ACCEPTED", "CANCEL_GOAL"): "CANCELING",
    ("EXECUTING", "CANCEL_GOAL"): "CANCELING",
    ("EXECUTING", "SUCCEED"): "SUCCEEDED",
    ("EXECUTING", "ABORT"): "ABORTED",
    ("CANCELING", "SUCCEED"): "SUCCEEDED",
    ("CANCELING", "ABORT"): "ABORTED",
    ("CANCELING", "CANCELED"): "CANCELED",
}
STATES = ("UNKNOWN", "ACCEPTED", "EXECUTING", "CANCELING", "SUCCEEDED", "CANCELED", "ABORTED")


def status(name: str) -> int:
    return getattr(GoalStatus, f"STATUS_{name}")


@pytest.mark.parametrize("event", GoalEvent, ids=lambda event: event.name)
@pytest.mark.parametrize("state", STATES)
def test_transition_follows_the_table(state: str, event: GoalEvent) -> None:
    goal = ALLOWED.get((state, event.name))
    if goal is not None:
        assert next_status(status(state), event) == status(goal)
        return
    with pytest.raises(RCLError) as error:
        next_status(status(state), event)
    assert str(error.value) == (
        f"Failed to update goal state: goal_handle attempted invalid transition from state {state} "
        f"with event {event.name}"
    )


def test_accepted_and_executing_goals_are_cancelable() -> None:
    assert [state for state in STATES if is_cancelable(status(state))] == ["ACCEPTED", "EXECUTING"]
