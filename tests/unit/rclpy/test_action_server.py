"""Action servers: accepting, executing, ending goals."""

from __future__ import annotations

from typing import Any

import pytest
from action_msgs.msg import GoalStatus, GoalStatusArray
from action_pair import Pair, succeed
from example_interfaces.action import Fibonacci
from rclpy._rclpy_pybind11 import InvalidHandle, RCLError
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.qos import qos_profile_action_status_default
from rclpy.task import Future
from std_msgs.msg import String
from unique_identifier_msgs.msg import UUID


def test_goal_succeeds(ros: Any) -> None:
    pair = Pair(ros)
    handle = pair.send(order=7)
    answer = pair.result(handle)
    assert handle.accepted
    assert (answer.status, list(answer.result.sequence)) == (GoalStatus.STATUS_SUCCEEDED, [7])


def test_goal_callback_gets_the_goal_and_may_reject(ros: Any) -> None:
    asked = []

    def odd(goal: Any) -> GoalResponse:
        asked.append(goal.order)
        return GoalResponse.ACCEPT if goal.order % 2 else GoalResponse.REJECT

    pair = Pair(ros, goal_callback=odd)
    assert [pair.send(order).accepted for order in (1, 2, 3)] == [True, False, True]
    assert asked == [1, 2, 3]


def test_goal_callback_must_return_a_goal_response(ros: Any, capfd: pytest.CaptureFixture[str]) -> None:
    pair = Pair(ros, goal_callback=lambda goal: True)
    assert not pair.send().accepted
    assert (
        "[server.action_server]: Goal request callback did not return a GoalResponse type. Rejecting goal."
        in capfd.readouterr().err
    )


def test_callbacks_may_be_coroutines(ros: Any) -> None:
    go: Future[None] = Future()

    async def accept(goal: Any) -> GoalResponse:
        await go
        return GoalResponse.ACCEPT

    async def execute(handle: Any) -> Any:
        return succeed(handle)

    pair = Pair(ros, execute, goal_callback=accept)
    sent = pair.client.send_goal_async(Fibonacci.Goal(order=3))
    ros.settle()
    assert not sent.done()
    go.set_result(None)
    assert list(pair.result(pair.outcome(sent)).result.sequence) == [3]


def test_goal_id_is_accepted_once(ros: Any) -> None:
    asked: list[Any] = []
    pair = Pair(
        ros,
        goal_callback=lambda goal: asked.append(goal) or GoalResponse.ACCEPT,
        handle_accepted_callback=lambda handle: None,
    )
    number = UUID(uuid=list(range(16)))
    node = ros.node("third")
    from rclpy.action import ActionClient

    other = ActionClient(node, Fibonacci, "fib")
    first = pair.outcome(pair.client.send_goal_async(Fibonacci.Goal(), goal_uuid=number))
    second = pair.outcome(other.send_goal_async(Fibonacci.Goal(), goal_uuid=number))
    assert (first.accepted, second.accepted, len(asked)) == (True, False, 1)


def test_deferred_goal_waits_for_execute(ros: Any) -> None:
    kept: list[Any] = []
    pair = Pair(ros, handle_accepted_callback=kept.append)
    asked = pair.send().get_result_async()
    ros.settle()
    (handle,) = kept
    assert (handle.status, handle.is_active, asked.done()) == (GoalStatus.STATUS_ACCEPTED, True, False)
    handle.execute()
    assert pair.outcome(asked).status == GoalStatus.STATUS_SUCCEEDED
    assert (handle.status, handle.is_active) == (GoalStatus.STATUS_SUCCEEDED, False)


def test_execute_accepts_another_callback(ros: Any) -> None:
    def abort(handle: Any) -> Any:
        handle.abort()
        return Fibonacci.Result(sequence=[9])

    pair = Pair(ros, handle_accepted_callback=lambda handle: handle.execute(abort))
    answer = pair.result(pair.send())
    assert (answer.status, list(answer.result.sequence)) == (GoalStatus.STATUS_ABORTED, [9])


def test_goal_without_terminal_state_is_aborted(ros: Any, capfd: pytest.CaptureFixture[str]) -> None:
    pair = Pair(ros, lambda handle: Fibonacci.Result(sequence=[1]))
    answer = pair.result(pair.send())
    assert (answer.status, list(answer.result.sequence)) == (GoalStatus.STATUS_ABORTED, [1])
    assert "Goal state not set, assuming aborted. Goal ID: [" in capfd.readouterr().err


def test_exception_in_execute_callback_aborts_the_goal(ros: Any, capfd: pytest.CaptureFixture[str]) -> None:
    def broken(handle: Any) -> Any:
        raise ValueError("no way")

    pair = Pair(ros, broken)
    answer = pair.result(pair.send())
    err = capfd.readouterr().err
    assert (answer.status, list(answer.result.sequence)) == (GoalStatus.STATUS_ABORTED, [])
    assert "[server.action_server]: Error raised in execute callback: no way" in err
    assert "ValueError: no way" in err


def test_result_of_another_class_is_reported_and_not_sent(ros: Any, capfd: pytest.CaptureFixture[str]) -> None:
    pair = Pair(ros, lambda handle: handle.succeed())
    asked = pair.send().get_result_async()
    with pytest.raises(TypeError, match="field 'result' of example_interfaces/action/Fibonacci_GetResult_Response"):
        pair.outcome(asked)
    assert f"The execute callback ({__file__}:" in (err := capfd.readouterr().err)
    assert "returned NoneType where Fibonacci.Result is needed" in err


@pytest.mark.parametrize("end", ["succeed", "abort", "canceled"])
def test_goal_ends_only_once(ros: Any, end: str) -> None:
    refused = []

    def twice(handle: Any) -> Any:
        handle.succeed()
        with pytest.raises(RCLError, match=r"from state SUCCEEDED with event \w+$"):
            getattr(handle, end)()
        refused.append(end)
        return Fibonacci.Result()

    pair = Pair(ros, twice)
    assert pair.result(pair.send()).status == GoalStatus.STATUS_SUCCEEDED
    assert refused == [end]


def test_status_topic_shows_late_joiners_the_last_state(ros: Any) -> None:
    pair = Pair(ros)
    pair.result(pair.send())
    seen: list[Any] = []
    late = ros.node("late")
    late.create_subscription(GoalStatusArray, "/fib/_action/status", seen.append, qos_profile_action_status_default)
    ros.spin(lambda: bool(seen))
    assert [each.status for each in seen[-1].status_list] == [GoalStatus.STATUS_SUCCEEDED]


def test_two_servers_of_a_node_do_not_interfere(ros: Any) -> None:
    from rclpy.action import ActionClient

    pair = Pair(ros)
    ActionServer(pair.server_node, Fibonacci, "other", lambda handle: handle.abort() or Fibonacci.Result())
    other = ActionClient(pair.client_node, Fibonacci, "other")
    handle = pair.outcome(other.send_goal_async(Fibonacci.Goal()))
    assert pair.result(handle).status == GoalStatus.STATUS_ABORTED
    assert pair.result(pair.send()).status == GoalStatus.STATUS_SUCCEEDED


def test_feedback_of_another_class_is_rejected(ros: Any) -> None:
    refused = []

    def execute(handle: Any) -> Any:
        with pytest.raises(TypeError):
            handle.publish_feedback(Fibonacci.Result())
        refused.append(True)
        return succeed(handle)

    pair = Pair(ros, execute)
    pair.result(pair.send())
    assert refused == [True]


def test_execute_callback_must_be_callable(ros: Any) -> None:
    with pytest.raises(TypeError, match=r"^Failed to register goal execution callback: not callable$"):
        ActionServer(ros.node(), Fibonacci, "fib", 5)  # type: ignore[arg-type]


@pytest.mark.parametrize(("kind", "error"), [(String, RuntimeError), (int, AttributeError)])
def test_only_action_types_can_be_served(ros: Any, kind: Any, error: type[Exception]) -> None:
    with pytest.raises(error):
        ActionServer(ros.node(), kind, "fib", succeed)


def test_destroyed_server_leaves_the_graph(ros: Any) -> None:
    pair = Pair(ros, handle_accepted_callback=lambda handle: None)
    handle = pair.send()
    pair.server.destroy()
    pair.server.destroy()
    assert not pair.client.server_is_ready()
    assert pair.server not in list(pair.server_node.waitables)
    asked = handle.get_result_async()
    ros.settle()
    assert not asked.done()


def test_goals_of_a_destroyed_server_raise_invalid_handle(ros: Any) -> None:
    kept: list[Any] = []
    pair = Pair(ros, handle_accepted_callback=kept.append)
    pair.send()
    pair.server.destroy()
    (handle,) = kept
    handle.publish_feedback(Fibonacci.Feedback())
    handle.succeed()
    assert (handle.status, handle.is_active) == (GoalStatus.STATUS_UNKNOWN, False)


@pytest.mark.parametrize("kind", ["goal", "cancel", "result"])
def test_server_that_is_destroyed_during_a_coroutine_sends_no_response(
    ros: Any, capfd: pytest.CaptureFixture[str], kind: str
) -> None:
    gates: dict[str, Any] = {"goal": Future(), "cancel": Future(), "result": Future()}

    async def accept(goal: Any) -> GoalResponse:
        await gates["goal"]
        return GoalResponse.ACCEPT

    async def cancel(handle: Any) -> CancelResponse:
        await gates["cancel"]
        return CancelResponse.ACCEPT

    async def execute(handle: Any) -> Any:
        await gates["result"]
        return Fibonacci.Result()

    pair = Pair(ros, execute, goal_callback=accept, cancel_callback=cancel)
    asked = pair.client.send_goal_async(Fibonacci.Goal())
    ros.settle()
    if kind != "goal":
        gates["goal"].set_result(None)
        handle = pair.outcome(asked)
        asked = handle.cancel_goal_async() if kind == "cancel" else handle.get_result_async()
        ros.settle()
    pair.server.destroy()
    gates[kind].set_result(None)
    ros.settle()
    assert not asked.done()
    assert f"Failed to send {kind} response (the action server was destroyed)" in capfd.readouterr().err


def test_server_is_destroyed_with_its_node(ros: Any) -> None:
    pair = Pair(ros)
    pair.server_node.destroy_node()
    assert not pair.client.server_is_ready()
    with pytest.raises(InvalidHandle):
        ActionServer(pair.server_node, Fibonacci, "fib", succeed)


def test_status_is_published_when_a_goal_is_accepted(ros: Any) -> None:
    pair = Pair(ros)
    seen: list[list[int]] = []
    late = ros.node("watcher")
    late.create_subscription(
        GoalStatusArray, "/fib/_action/status", lambda m: seen.append([each.status for each in m.status_list]), 10
    )
    pair.result(pair.send())
    ros.settle()
    assert seen == [[GoalStatus.STATUS_ACCEPTED], [GoalStatus.STATUS_EXECUTING], [GoalStatus.STATUS_SUCCEEDED]]
