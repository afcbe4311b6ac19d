"""Action clients: feedback, status, waiting, and errors."""

from __future__ import annotations

import gc
import threading
from typing import Any

import pytest
from action_msgs.msg import GoalStatus
from action_pair import Pair, succeed
from example_interfaces.action import Fibonacci
from rclpy._rclpy_pybind11 import InvalidHandle
from rclpy.action import ActionClient, ActionServer, GoalResponse
from rclpy.executors import SingleThreadedExecutor
from rclpy.task import Future


def test_feedback_reaches_only_its_goal(ros: Any) -> None:
    ready: list[Any] = []
    pair = Pair(ros, handle_accepted_callback=ready.append)
    seen: dict[str, list[list[int]]] = {"a": [], "b": []}
    pair.send(feedback_callback=lambda message: seen["a"].append(list(message.feedback.sequence)))
    pair.send(feedback_callback=lambda message: seen["b"].append(list(message.feedback.sequence)))
    first, second = ready
    for handle, numbers in ((first, [1]), (second, [2]), (first, [1, 1])):
        handle.publish_feedback(Fibonacci.Feedback(sequence=numbers))
    ros.spin(lambda: len(seen["a"]) + len(seen["b"]) == 3)
    assert seen == {"a": [[1], [1, 1]], "b": [[2]]}


class FreeWorker(SingleThreadedExecutor):
    """Runs each task at once, like a pool with an idle thread."""

    def create_task(self, callback: Any, *args: Any, **kwargs: Any) -> Any:
        return callback(*args, **kwargs)


def test_accepted_goal_has_its_status_when_its_future_is_done(ros: Any) -> None:
    client_side = FreeWorker(context=ros.init())
    go: Future[None] = Future()

    async def execute(handle: Any) -> Any:
        await go
        return succeed(handle)

    pair = Pair(ros, execute)
    client_side.add_node(pair.client_node)
    statuses: list[int] = []
    future = pair.client.send_goal_async(Fibonacci.Goal())
    future.add_done_callback(lambda done: statuses.append(done.result().status))
    ros.settle()
    client_side.spin_until_future_complete(future)
    assert statuses == [GoalStatus.STATUS_EXECUTING]
    go.set_result(None)


def test_feedback_is_a_copy(ros: Any) -> None:
    ready: list[Any] = []
    seen: list[Any] = []
    pair = Pair(ros, handle_accepted_callback=ready.append)
    pair.send(feedback_callback=lambda message: seen.append(message.feedback))
    feedback = Fibonacci.Feedback(sequence=[1])
    ready[0].publish_feedback(feedback)
    feedback.sequence.append(2)
    ros.spin(lambda: bool(seen))
    assert list(seen[0].sequence) == [1]


def test_feedback_callback_may_be_a_coroutine_function(ros: Any) -> None:
    ready: list[Any] = []
    seen: list[Any] = []
    go: Future[None] = Future()
    pair = Pair(ros, handle_accepted_callback=ready.append)

    async def report(message: Any) -> None:
        await go
        seen.append(message)

    pair.send(feedback_callback=report)
    ready[0].publish_feedback(Fibonacci.Feedback())
    ros.settle()
    assert seen == []
    go.set_result(None)
    ros.spin(lambda: bool(seen))


def test_handle_follows_the_status(ros: Any) -> None:
    go: Future[None] = Future()

    async def execute(handle: Any) -> Any:
        await go
        return succeed(handle)

    pair = Pair(ros, execute)
    handle = pair.send()
    ros.spin(lambda: handle.status == GoalStatus.STATUS_EXECUTING)
    go.set_result(None)
    ros.spin(lambda: handle.status == GoalStatus.STATUS_SUCCEEDED)
    assert repr(handle).endswith("accepted=True, status=4>")


def test_rejected_goal_has_unknown_status(ros: Any) -> None:
    pair = Pair(ros, goal_callback=lambda goal: GoalResponse.REJECT)
    handle = pair.send()
    assert (handle.accepted, handle.status) == (False, GoalStatus.STATUS_UNKNOWN)
    assert pair.result(handle).status == GoalStatus.STATUS_UNKNOWN


def test_result_may_be_requested_repeatedly(ros: Any) -> None:
    pair = Pair(ros)
    handle = pair.send(5)
    assert [list(pair.result(handle).result.sequence) for _ in range(3)] == [[5]] * 3


def test_goal_handles_are_not_kept(ros: Any) -> None:
    pair = Pair(ros, handle_accepted_callback=lambda handle: None)
    for _ in range(20):
        pair.send()
    gc.collect()
    pair.server._publish_status()
    ros.settle()
    assert pair.client._goal_handles == {}


def test_cancelled_send_is_forgotten(ros: Any, capfd: pytest.CaptureFixture[str]) -> None:
    pair = Pair(ros)
    sent = pair.client.send_goal_async(Fibonacci.Goal())
    sent.cancel()
    ros.settle()
    assert not sent.done()
    assert (
        "[client.action_client]: Ignoring unexpected goal response. There may be more than one action server for the "
        "action 'fib'" in capfd.readouterr().err
    )


def test_two_servers_of_an_action_are_reported(ros: Any, capfd: pytest.CaptureFixture[str]) -> None:
    pair = Pair(ros)
    ActionServer(ros.node("second"), Fibonacci, "fib", succeed)
    pair.send()
    ros.settle()
    assert "Ignoring unexpected goal response" in capfd.readouterr().err


def test_feedback_is_received_until_the_result(ros: Any) -> None:
    pair = Pair(ros)
    seen: list[Any] = []
    handle = pair.send(feedback_callback=seen.append)
    pair.result(handle)
    ros.settle()
    pair.server._publish_feedback(Fibonacci.Impl.FeedbackMessage(goal_id=handle.goal_id))
    ros.settle()
    assert seen == []


def test_ended_goal_is_no_longer_tracked(ros: Any) -> None:
    pair = Pair(ros)
    handle = pair.send()
    ros.spin(lambda: handle.status == GoalStatus.STATUS_SUCCEEDED)
    assert pair.client._goal_handles == {}


def test_exception_of_a_done_callback_leaves_the_executor(ros: Any) -> None:
    def broken(future: Any) -> None:
        raise ValueError("in a done callback")

    pair = Pair(ros)
    pair.client.send_goal_async(Fibonacci.Goal()).add_done_callback(broken)
    with pytest.raises(ValueError, match="in a done callback"):
        ros.settle()


def test_done_callbacks_may_send_further_requests(ros: Any) -> None:
    pair = Pair(ros)
    order: list[str] = []
    pair.client.send_goal_async(Fibonacci.Goal()).add_done_callback(
        lambda sent: sent.result().get_result_async().add_done_callback(lambda asked: order.append("result"))
    )
    ros.spin(lambda: order == ["result"])


def test_blocking_send_goal_works_in_another_thread(ros: Any) -> None:
    pair = Pair(ros)
    answer: Future[Any] = Future()
    thread = threading.Thread(target=lambda: answer.set_result(pair.client.send_goal(Fibonacci.Goal(order=4))))
    thread.start()
    executor = SingleThreadedExecutor(context=ros.context)
    for node in (pair.server_node, pair.client_node):
        executor.add_node(node)
    executor.spin_until_future_complete(answer, timeout_sec=60.0)
    thread.join()
    assert list(answer.result().result.sequence) == [4]


def test_wait_for_server_notices_a_new_server(ros: Any) -> None:
    node = ros.node()
    client = ActionClient(node, Fibonacci, "fib")
    assert not client.wait_for_server(timeout_sec=0.0)
    found: list[bool] = []
    thread = threading.Thread(target=lambda: found.append(client.wait_for_server(timeout_sec=60.0)))
    thread.start()
    ActionServer(node, Fibonacci, "fib", succeed)
    thread.join()
    assert found == [True]


@pytest.mark.parametrize("call", ["send_goal_async", "_cancel_goal_async", "_get_result_async"])
def test_wrong_classes_are_rejected(ros: Any, call: str) -> None:
    client = ActionClient(ros.node(), Fibonacci, "fib")
    with pytest.raises(TypeError):
        getattr(client, call)(Fibonacci.Result())


def test_destroyed_client_raises_invalid_handle(ros: Any) -> None:
    pair = Pair(ros)
    handle = pair.send()
    pair.client.destroy()
    for use in (pair.client.server_is_ready, handle.get_result_async, handle.cancel_goal_async):
        with pytest.raises(InvalidHandle):
            use()
    assert list(pair.client_node.waitables) == []


def test_server_and_client_work_in_one_node_and_executor(ros: Any) -> None:
    node = ros.node()
    ActionServer(node, Fibonacci, "fib", succeed)
    client = ActionClient(node, Fibonacci, "fib")
    done: list[Any] = []

    async def ask() -> None:
        handle = await client.send_goal_async(Fibonacci.Goal(order=2))
        done.append(await handle.get_result_async())

    executor = SingleThreadedExecutor(context=ros.context)
    executor.add_node(node)
    task = executor.create_task(ask)
    executor.spin_until_future_complete(task)
    assert list(done[0].result.sequence) == [2]
