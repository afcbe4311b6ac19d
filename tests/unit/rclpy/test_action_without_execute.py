"""Action servers without an execute callback: the goal is ended by whatever `handle_accepted_callback` hands it to."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from action_msgs.msg import GoalStatus
from action_pair import Pair
from example_interfaces.action import Fibonacci
from rclpy._rclpy_pybind11 import RCLError
from rclpy.action import CancelResponse
from rclpy.task import Future

ENDS: dict[str, tuple[Callable[[Any, Any], None], int]] = {
    "succeed": (lambda handle, result: handle.succeed(result), GoalStatus.STATUS_SUCCEEDED),
    "abort": (lambda handle, result: handle.abort(result), GoalStatus.STATUS_ABORTED),
}


@pytest.mark.parametrize("result", [Fibonacci.Result(sequence=[4]), None], ids=["result", "no result"])
@pytest.mark.parametrize("how", ENDS)
def test_goal_is_ended_by_its_kept_handle(ros: Any, how: str, result: Any) -> None:
    kept: list[Any] = []
    end, status = ENDS[how]
    pair = Pair(ros, None, handle_accepted_callback=kept.append)
    asked = pair.send().get_result_async()
    ros.settle()
    kept[0].executing()
    assert kept[0].status == GoalStatus.STATUS_EXECUTING and not asked.done()
    end(kept[0], result)
    answer = pair.outcome(asked)
    assert (answer.status, list(answer.result.sequence)) == (status, [4] if result else [])


def test_cancelled_goal_is_ended_with_its_result(ros: Any) -> None:
    kept: list[Any] = []
    accept = {"cancel_callback": lambda handle: CancelResponse.ACCEPT}
    pair = Pair(ros, None, handle_accepted_callback=kept.append, **accept)
    goal = pair.send()
    pair.outcome(goal.cancel_goal_async())
    kept[0].executing()
    assert kept[0].is_cancel_requested
    kept[0].canceled(Fibonacci.Result(sequence=[8]))
    answer = pair.result(goal)
    assert (answer.status, list(answer.result.sequence)) == (GoalStatus.STATUS_CANCELED, [8])


def test_timer_drives_the_goal(ros: Any) -> None:
    """The case of public examples: a robot's end stop, a button, a countdown end the goal."""
    left: list[int] = []
    seen: list[int] = []

    def accepted(handle: Any) -> None:
        handle.executing()
        left.extend([2, 1])

        def step() -> None:
            if left:
                handle.publish_feedback(Fibonacci.Feedback(sequence=[left.pop(0)]))
                return
            timer.cancel()
            handle.succeed(Fibonacci.Result(sequence=[0]))

        timer = pair.server_node.create_timer(0.001, step)

    pair = Pair(ros, None, handle_accepted_callback=accepted)
    goal = pair.send(feedback_callback=lambda message: seen.extend(message.feedback.sequence))
    assert list(pair.result(goal).result.sequence) == [0]
    ros.settle()
    assert seen == [2, 1]


def test_handle_executes_with_a_callback_of_its_own(ros: Any) -> None:
    def execute(handle: Any) -> Any:
        handle.succeed()
        return Fibonacci.Result(sequence=[3])

    pair = Pair(ros, None, handle_accepted_callback=lambda handle: handle.execute(execute))
    assert list(pair.result(pair.send()).result.sequence) == [3]


def test_execute_without_any_callback_marks_the_goal_as_executing(ros: Any) -> None:
    pair = Pair(ros, None, handle_accepted_callback=lambda handle: (handle.execute(), handle.succeed()))
    assert pair.result(pair.send()).status == GoalStatus.STATUS_SUCCEEDED


def test_goal_must_execute_before_it_succeeds(ros: Any) -> None:
    kept: list[Any] = []
    pair = Pair(ros, None, handle_accepted_callback=kept.append)
    pair.send()
    with pytest.raises(RCLError, match="goal_handle attempted invalid transition from state ACCEPTED with event SUCC"):
        kept[0].succeed()


def test_result_of_the_callback_is_sent_if_none_was_given(ros: Any) -> None:
    """rclpy 7.1.8 and 7.1.9 send an empty result here when the client asks first."""
    go: Future[None] = Future()

    async def execute(handle: Any) -> Any:
        handle.succeed()
        await go
        return Fibonacci.Result(sequence=[7])

    pair = Pair(ros, execute)
    asked = pair.send().get_result_async()
    ros.settle()
    assert not asked.done()
    go.set_result(None)
    assert list(pair.outcome(asked).result.sequence) == [7]


def test_result_given_to_succeed_needs_no_return(ros: Any, capfd: pytest.CaptureFixture[str]) -> None:
    pair = Pair(ros, lambda handle: handle.succeed(Fibonacci.Result(sequence=[5])))
    assert list(pair.result(pair.send()).result.sequence) == [5]
    assert "returned NoneType" not in capfd.readouterr().err


def test_server_that_neither_keeps_nor_executes_goals_warns(ros: Any, capfd: pytest.CaptureFixture[str]) -> None:
    Pair(ros, None)
    assert "Not handling nor executing the goal, this server will do nothing" in capfd.readouterr().err
