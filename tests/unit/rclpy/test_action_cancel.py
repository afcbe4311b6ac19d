"""Which goals a cancel request refers to, and what happens to them."""

from __future__ import annotations

from typing import Any

import pytest
from action_msgs.msg import GoalInfo, GoalStatus
from action_msgs.srv import CancelGoal
from action_pair import Pair
from builtin_interfaces.msg import Time
from example_interfaces.action import Fibonacci
from rclpy._rclpy_pybind11 import RCLError
from rclpy.action import CancelResponse
from rclpy.task import Future
from unique_identifier_msgs.msg import UUID

NONE, UNKNOWN, TERMINATED = (
    CancelGoal.Response.ERROR_NONE,
    CancelGoal.Response.ERROR_UNKNOWN_GOAL_ID,
    CancelGoal.Response.ERROR_GOAL_TERMINATED,
)
LATE = Time(sec=2**31 - 1)
EARLY = Time(sec=1)


class HeldGoals(Pair):
    """Goals that execute until `go` is done; cancel requests are answered with `agree`."""

    def __init__(self, ros: Any, agree: Any = CancelResponse.ACCEPT) -> None:
        self.go: Future[None] = Future()
        self.asked: list[int] = []
        super().__init__(ros, self.execute, cancel_callback=self.cancel)
        self.agree = agree

    async def execute(self, handle: Any) -> Any:
        await self.go
        handle.canceled() if handle.is_cancel_requested else handle.succeed()
        return Fibonacci.Result(sequence=[handle.request.order])

    def cancel(self, handle: Any) -> Any:
        self.asked.append(handle.request.order)
        return self.agree

    def request(self, uuid: Any = None, stamp: Any = None) -> Any:
        """Send a cancel request with these fields and return the response."""
        info = GoalInfo(goal_id=uuid or UUID(), stamp=stamp or Time())
        return self.ros.ask(self.client_node, CancelGoal, "/fib/_action/cancel_goal", goal_info=info)


def ids(response: Any) -> list[bytes]:
    return [bytes(each.goal_id.uuid) for each in response.goals_canceling]


def test_goal_is_cancelled(ros: Any) -> None:
    pair = HeldGoals(ros)
    handle = pair.send(3)
    asked = handle.get_result_async()
    answer = pair.outcome(handle.cancel_goal_async())
    assert (answer.return_code, ids(answer)) == (NONE, [bytes(handle.goal_id.uuid)])
    pair.go.set_result(None)
    result = pair.outcome(asked)
    assert (result.status, list(result.result.sequence)) == (GoalStatus.STATUS_CANCELED, [3])


def test_rejected_cancel_changes_nothing(ros: Any) -> None:
    pair = HeldGoals(ros, CancelResponse.REJECT)
    handle = pair.send(3)
    answer = pair.outcome(handle.cancel_goal_async())
    assert (answer.return_code, ids(answer), pair.asked) == (NONE, [], [3])
    pair.go.set_result(None)
    assert pair.result(handle).status == GoalStatus.STATUS_SUCCEEDED


def test_second_cancel_finds_the_goal_no_longer_cancelable(ros: Any) -> None:
    pair = HeldGoals(ros)
    handle = pair.send()
    pair.outcome(handle.cancel_goal_async())
    answer = pair.outcome(handle.cancel_goal_async())
    assert (answer.return_code, ids(answer)) == (TERMINATED, [])


def test_ended_goal_cannot_be_cancelled(ros: Any) -> None:
    pair = HeldGoals(ros)
    pair.go.set_result(None)
    handle = pair.send()
    pair.result(handle)
    answer = pair.outcome(handle.cancel_goal_async())
    assert (answer.return_code, ids(answer), pair.asked) == (TERMINATED, [], [])


@pytest.mark.parametrize(
    ("which", "stamp", "code", "cancelled"),
    [
        ("none", None, NONE, [1, 2, 3]),
        ("none", EARLY, NONE, []),
        ("none", LATE, NONE, [1, 2, 3]),
        ("second", None, NONE, [2]),
        ("second", EARLY, NONE, [2]),
        ("second", LATE, NONE, [1, 2, 3]),
        ("stranger", None, UNKNOWN, []),
        ("stranger", EARLY, NONE, []),
        ("stranger", LATE, NONE, [1, 2, 3]),
    ],
)
def test_cancel_request_selects_goals_by_id_and_stamp(
    ros: Any, which: str, stamp: Any, code: int, cancelled: list[int]
) -> None:
    pair = HeldGoals(ros)
    handles = {order: pair.send(order) for order in (1, 2, 3)}
    uuid = {"none": None, "second": handles[2].goal_id, "stranger": UUID(uuid=[1] * 16)}[which]
    answer = pair.request(uuid, stamp)
    assert (answer.return_code, pair.asked) == (code, cancelled)
    assert ids(answer) == [bytes(handles[order].goal_id.uuid) for order in cancelled]


def test_cancel_request_asks_about_all_goals_even_if_some_are_rejected(ros: Any) -> None:
    pair = HeldGoals(ros)
    handles = {order: pair.send(order) for order in (1, 2, 3, 4)}
    pair.server.register_cancel_callback(
        lambda handle: CancelResponse.ACCEPT if handle.request.order == 3 else CancelResponse.REJECT
    )
    assert ids(pair.request()) == [bytes(handles[3].goal_id.uuid)]


def test_goal_may_be_cancelled_before_execution(ros: Any) -> None:
    pair = HeldGoals(ros)
    kept: list[Any] = []
    pair.server.register_handle_accepted_callback(kept.append)
    pair.go.set_result(None)
    handle = pair.send()
    pair.outcome(handle.cancel_goal_async())
    assert kept[0].is_cancel_requested
    kept[0].execute()
    assert pair.result(handle).status == GoalStatus.STATUS_CANCELED


def test_goal_may_end_while_the_cancel_callback_runs(ros: Any) -> None:
    pair = HeldGoals(ros)
    thought: Future[None] = Future()

    async def think(handle: Any) -> CancelResponse:
        await thought
        return CancelResponse.ACCEPT

    kept: list[Any] = []
    pair.server.register_cancel_callback(think)
    pair.server.register_handle_accepted_callback(kept.append)
    handle = pair.send()
    asked = handle.cancel_goal_async()
    ros.settle()
    kept[0]._update_state(_execute())
    kept[0].succeed()
    thought.set_result(None)
    assert ids(pair.outcome(asked)) == []
    assert kept[0].status == GoalStatus.STATUS_SUCCEEDED


def _execute() -> Any:
    from rclpy.action.goal_state import GoalEvent

    return GoalEvent.EXECUTE


def test_canceled_without_a_request_is_an_error(ros: Any, capfd: pytest.CaptureFixture[str]) -> None:
    def execute(handle: Any) -> Any:
        with pytest.raises(RCLError, match="from state EXECUTING with event CANCELED"):
            handle.canceled()
        handle.abort()
        return Fibonacci.Result()

    pair = Pair(ros, execute)
    assert pair.result(pair.send()).status == GoalStatus.STATUS_ABORTED
    assert "Error raised" not in capfd.readouterr().err
