"""Executors: the order of callbacks, how long they wait, and what ends them."""

from __future__ import annotations

import contextlib
import threading
from typing import Any

import pytest
import rclpy
from bot_console.runtime.process import on_notice
from rclpy._rclpy_pybind11 import RCLError
from rclpy.context import Context
from rclpy.executors import (
    ExternalShutdownException,
    MultiThreadedExecutor,
    SingleThreadedExecutor,
    TimeoutException,
)
from rclpy.impl import explanations
from rclpy.task import Future
from std_msgs.msg import Int32
from std_srvs.srv import Trigger


def create_all_ready(ros: Any, node: Any, got: list[str], tag: str = "") -> None:
    """Create one entity of each kind in reverse order of service, all ready."""
    requester = ros.node(f"asker{tag}")
    node.create_service(Trigger, f"s{tag}", lambda request, response: (got.append(f"service{tag}"), response)[1])
    guard = node.create_guard_condition(lambda: got.append(f"guard{tag}"))
    node.create_subscription(Int32, f"t{tag}", lambda message: got.append(f"subscription{tag}"), 10)
    timer = node.create_timer(0.0, lambda: (got.append(f"timer{tag}"), timer.cancel()))
    client = requester.create_client(Trigger, f"s{tag}")
    client.call_async(Trigger.Request())
    requester.create_publisher(Int32, f"t{tag}", 10).publish(Int32())
    guard.trigger()


def test_kinds_of_entities_are_served_in_order(ros: Any) -> None:
    got: list[str] = []
    create_all_ready(ros, ros.node(), got)
    ros.spin(lambda: "service" in got)
    assert got == ["timer", "subscription", "guard", "service"]


def test_nodes_are_served_one_after_the_other(ros: Any) -> None:
    got: list[str] = []
    first, second = ros.node("first"), ros.node("second")
    create_all_ready(ros, second, got, "2")
    create_all_ready(ros, first, got, "1")
    ros.spin(lambda: len(got) >= 8)
    assert [each[-1] for each in got] == ["1"] * 4 + ["2"] * 4


def test_each_subscription_takes_one_message_per_wake(ros: Any) -> None:
    node, got = ros.node(), []
    for topic in ("b", "a"):
        node.create_subscription(Int32, topic, lambda message, topic=topic: got.append((topic, message.data)), 10)
    publishers = [node.create_publisher(Int32, topic, 10) for topic in ("a", "b")]
    for number in range(3):
        for publisher in publishers:
            publisher.publish(Int32(data=number))
    ros.spin(lambda: len(got) >= 6)
    assert got == [("b", 0), ("a", 0), ("b", 1), ("a", 1), ("b", 2), ("a", 2)]


def test_spin_once_runs_one_callback(ros: Any) -> None:
    node, got = ros.node(), []
    for name in "abc":
        node.create_guard_condition(lambda name=name: got.append(name)).trigger()
    executor = node.executor
    seen = []
    for _ in range(3):
        executor.spin_once(timeout_sec=1.0)
        seen.append("".join(got))
    assert seen == ["a", "ab", "abc"]


def test_tasks_run_first_and_the_newest_before_all(ros: Any) -> None:
    node, got = ros.node(), []
    node.create_guard_condition(lambda: got.append("guard")).trigger()
    for name in ("old", "new"):
        node.executor.create_task(got.append, name)
    for _ in range(3):
        node.executor.spin_once(timeout_sec=1.0)
    assert got == ["new", "old", "guard"]


def test_poll_after_the_last_callback_of_a_wake_takes_nothing(ros: Any) -> None:
    node, got = ros.node(), []
    node.create_subscription(Int32, "t", lambda message: got.append(message.data), 10)
    publisher = node.create_publisher(Int32, "t", 10)
    for number in range(3):
        publisher.publish(Int32(data=number))
    seen = []
    for _ in range(6):
        node.executor.spin_once(timeout_sec=0)
        seen.append(len(got))
    assert seen == [1, 1, 2, 2, 3, 3]


def test_entities_may_be_created_and_destroyed_within_a_wake(ros: Any) -> None:
    node, got = ros.node(), []

    def first() -> None:
        got.append("first")
        node.destroy_guard_condition(second)
        node.create_guard_condition(lambda: got.append("new")).trigger()

    node.create_guard_condition(first).trigger()
    second = node.create_guard_condition(lambda: got.append("second"))
    second.trigger()
    ros.spin(lambda: "new" in got)
    assert got == ["first", "new"]


def test_spin_once_waits_until_its_timeout(stepped_ros: Any) -> None:
    node = stepped_ros.node()
    clock = node.get_clock()
    before = clock.now()
    assert node.executor.spin_once(timeout_sec=0.25) is None
    assert (clock.now() - before).nanoseconds == 250_000_000
    node.executor.spin_once(timeout_sec=0)
    assert (clock.now() - before).nanoseconds // 1_000_000 == 250


def test_negative_timeout_waits_indefinitely(stepped_ros: Any) -> None:
    node, got = stepped_ros.node(), []
    node.create_timer(3600.0, lambda: got.append(1))
    node.executor.spin_once(timeout_sec=-1)
    assert got == [1]


def test_exception_leaves_spin(ros: Any) -> None:
    node = ros.node()
    group = node.default_callback_group
    node.create_guard_condition(lambda: {}["missing"]).trigger()
    with pytest.raises(KeyError, match="missing"):
        node.executor.spin_once()
    assert group.can_execute(None), "the callback's group is free again"


def test_exception_in_a_coroutine_leaves_spin(ros: Any) -> None:
    node, go = ros.node(), Future()

    async def fail() -> None:
        await go
        raise KeyError("late")

    node.create_guard_condition(fail).trigger()
    node.executor.spin_once()
    go.set_result(None)
    with pytest.raises(KeyError, match="late"):
        node.executor.spin_once()
    assert node.default_callback_group.can_execute(None)


def test_coroutines_resume_newest_first(ros: Any) -> None:
    node, go, got = ros.node(), Future(), []

    async def wait(name: str) -> None:
        await go
        got.append(name)

    for name in "abc":
        node.executor.create_task(wait, name)
    for _ in range(3):
        node.executor.spin_once(timeout_sec=1.0)
    go.set_result(None)
    for _ in range(3):
        node.executor.spin_once(timeout_sec=1.0)
    assert got == ["c", "b", "a"]


def test_node_belongs_to_one_executor(ros: Any) -> None:
    node = ros.node()
    first, second = node.executor, SingleThreadedExecutor(context=ros.context)
    assert second.add_node(node) and not second.add_node(node)
    assert (node.executor, first.get_nodes(), second.get_nodes()) == (second, [], [node])
    assert second.remove_node(node) is None
    assert node.executor is second, "upstream leaves the pointer"
    second.remove_node(node)


def test_removed_node_is_not_served(ros: Any) -> None:
    node, other, got = ros.node(), ros.node("other"), []
    guard = node.create_guard_condition(lambda: got.append("node"))
    guard.trigger()
    node.executor.remove_node(node)
    other.create_guard_condition(lambda: got.append("other")).trigger()
    other.executor.spin_once(timeout_sec=1.0)
    assert got == ["other"]
    other.executor.add_node(node)
    other.executor.spin_once(timeout_sec=1.0)
    assert got == ["other", "node"], "a wake-up in the meantime is not lost"


def test_destroyed_node_does_not_disturb_others(ros: Any) -> None:
    node, other, got = ros.node(), ros.node("other"), []
    node.create_guard_condition(lambda: got.append("node")).trigger()
    other.create_guard_condition(lambda: got.append("other")).trigger()
    node.destroy_node()
    ros.spin(lambda: bool(got))
    assert got == ["other"]


@pytest.mark.parametrize("kind", [SingleThreadedExecutor, MultiThreadedExecutor])
def test_executor_needs_an_initialized_context(kind: Any) -> None:
    context = Context()
    with pytest.raises(TypeError):
        kind(context=context)
    context.init([])
    context.shutdown()
    with pytest.raises(RCLError, match="failed to create guard_condition: the given context is not valid"):
        kind(context=context)


def test_shut_down_executor_runs_no_callbacks(ros: Any) -> None:
    node, got = ros.node(), []
    executor = SingleThreadedExecutor(context=ros.context)
    node.create_guard_condition(lambda: got.append(1)).trigger()
    executor.add_node(node)
    assert executor.shutdown() is True
    executor.spin_once()
    executor.spin()
    executor.wake()
    assert (got, executor.get_nodes(), executor.shutdown()) == ([], [], True)
    with pytest.raises(AttributeError):
        executor.create_task(print)
    with pytest.raises(AttributeError):
        executor.add_node(node)


def test_with_block_shuts_the_executor_down(ros: Any) -> None:
    with SingleThreadedExecutor(context=ros.init()) as executor:
        executor.create_task(lambda: None)
    with pytest.raises(AttributeError):
        executor.create_task(print)


def test_spin_returns_silently_if_a_callback_shuts_down(ros: Any) -> None:
    node = ros.node()
    node.create_guard_condition(ros.context.shutdown).trigger()
    assert node.executor.spin() is None


def test_spin_once_raises_if_the_context_has_ended(ros: Any) -> None:
    node = ros.node()
    ros.context.shutdown()
    with pytest.raises(ExternalShutdownException):
        node.executor.spin_once(timeout_sec=0)


@pytest.mark.parametrize(("timeout", "waited"), [(0.5, 500), (0, 0)])
def test_spin_until_future_complete_times_out(stepped_ros: Any, timeout: float, waited: int) -> None:
    node = stepped_ros.node()
    start = node.get_clock().now()
    assert node.executor.spin_until_future_complete(Future(), timeout) is None
    assert (node.get_clock().now() - start).nanoseconds // 1_000_000 == waited


def test_spin_until_future_complete_ends_with_the_future(stepped_ros: Any) -> None:
    node, future = stepped_ros.node(), Future()
    start = node.get_clock().now()
    node.create_timer(0.1, lambda: future.set_result("x") if future.done() is False else None)
    node.executor.spin_until_future_complete(future, 5.0)
    assert future.result() == "x"
    assert (node.get_clock().now() - start).nanoseconds == 100_000_000


def test_create_task_returns_a_future(ros: Any) -> None:
    executor = ros.node().executor
    task = executor.create_task(lambda a, b=0: a + b, 2, b=3)
    assert (task.done(), task.result()) == (False, None)
    executor.spin_until_future_complete(task)
    assert task.result() == 5


def test_timeout_exception_is_not_a_builtin_timeout_error() -> None:
    assert not issubclass(TimeoutException, TimeoutError)


def test_exception_of_a_pool_callback_is_raised_unchanged(ros: Any) -> None:
    node = ros.node()

    def fail() -> None:
        raise RuntimeError("broken")

    node.create_timer(0.001, fail)
    executor = MultiThreadedExecutor(2, context=ros.context)
    executor.add_node(node)
    with pytest.raises(RuntimeError, match="broken") as reported:
        executor.spin()
    executor.shutdown()
    assert reported.value.__context__ is None


@pytest.mark.filterwarnings("ignore:MultiThreadedExecutor is used")
def test_system_exit_in_a_pool_callback_ends_only_that_callback(ros: Any) -> None:
    node = ros.node()
    calls: list[int] = []

    def exits_at_first() -> None:
        calls.append(1)
        if len(calls) == 1:
            raise SystemExit(3)

    node.create_timer(0.001, exits_at_first)
    executor = MultiThreadedExecutor(1, context=ros.context)
    executor.add_node(node)
    for _ in range(1000):
        executor.spin_once(timeout_sec=0.01)
        if len(calls) > 2:
            break
    executor.shutdown()
    assert len(calls) > 2


@pytest.mark.parametrize("has_node", [True, False])
def test_spin_leaves_a_node_with_the_executor_that_had_it(ros: Any, has_node: bool) -> None:
    node, executor = ros.node(), SingleThreadedExecutor(context=ros.context)
    if has_node:
        executor.add_node(node)
    node.create_guard_condition(ros.context.shutdown).trigger()
    with contextlib.suppress(ExternalShutdownException):
        rclpy.spin(node, executor)
    assert executor.get_nodes() == [node] * has_node


@pytest.mark.parametrize("poll", ["spin_until_future_complete", "spin_once_until_future_complete"])
def test_polled_future_wakes_the_executor_once(ros: Any, poll: str) -> None:
    ros.node()
    executor, future, wakes = SingleThreadedExecutor(context=ros.context), Future(), []
    executor.wake = lambda: wakes.append("woken")
    for _ in range(20):
        getattr(executor, poll)(future, timeout_sec=0)
    wakes.clear()
    future.set_result(None)
    assert wakes == ["woken"]


@pytest.mark.parametrize("waits", [True, False])
def test_shutdown_waits_for_running_callbacks_by_default(ros: Any, waits: bool) -> None:
    node, begun, may_end = ros.node(), threading.Event(), threading.Event()
    ended: list[bool] = []

    def work() -> None:
        begun.set()
        may_end.wait(240.0)
        ended.append(True)

    node.create_guard_condition(work).trigger()
    executor = MultiThreadedExecutor(2, context=ros.context)
    executor.add_node(node)
    while not begun.is_set():
        executor.spin_once(timeout_sec=0.01)
    if waits:
        may_end.set()
    executor.shutdown(wait_for_threads=waits)
    assert ended == [True] * waits
    may_end.set()


def _waiting_thread(executor: Any, wait: Any) -> tuple[threading.Thread, list[BaseException]]:
    """Return a thread that has begun to wait for work, and the exceptions raised by its wait."""
    errors: list[BaseException] = []

    def run() -> None:
        try:
            wait()
        except BaseException as error:
            errors.append(error)

    thread = threading.Thread(target=run)
    thread.start()
    while not executor._waiting and thread.is_alive():
        thread.join(0.001)
    return thread, errors


SPINS: dict[str, Any] = {
    "spin": lambda executor, node, future: executor.spin(),
    "spin_once": lambda executor, node, future: executor.spin_once(),
    "rclpy.spin": lambda executor, node, future: rclpy.spin(node, executor),
    "rclpy.spin_once": lambda executor, node, future: rclpy.spin_once(node, executor=executor),
    "until a future": lambda executor, node, future: executor.spin_until_future_complete(future),
    "ready callbacks": lambda executor, node, future: executor.wait_for_ready_callbacks(),
}


@pytest.mark.parametrize("how", SPINS)
@pytest.mark.parametrize("kind", [SingleThreadedExecutor, MultiThreadedExecutor])
def test_second_thread_spinning_the_same_executor_gets_a_value_error(ros: Any, kind: Any, how: str) -> None:
    executor, node, future = kind(context=ros.init()), ros.node(), Future()
    executor.add_node(node)
    thread, errors = _waiting_thread(executor, lambda: SPINS[how](executor, node, future))
    with pytest.raises(ValueError, match=r"^generator already executing$"):
        SPINS[how](executor, node, future)
    future.set_result(None)
    ros.context.shutdown()
    thread.join()
    assert not [each for each in errors if isinstance(each, ValueError)], "the first one continues"


def test_two_threads_may_wait_for_different_things(ros: Any) -> None:
    executor, node = SingleThreadedExecutor(context=ros.init()), ros.node()
    executor.add_node(node)
    thread, errors = _waiting_thread(executor, executor.spin)
    executor.spin_once(timeout_sec=0.01)
    executor.spin_once_until_future_complete(Future(), timeout_sec=0.01)
    rclpy.spin_once(node, executor=executor, timeout_sec=0)
    ros.context.shutdown()
    thread.join()
    assert not [each for each in errors if isinstance(each, ValueError)]


def test_callback_may_spin_its_own_executor(ros: Any) -> None:
    executor, node, seen = SingleThreadedExecutor(context=ros.init()), ros.node(), list[str]()
    executor.add_node(node)
    node.create_timer(0.001, lambda: (executor.spin_once(timeout_sec=0.0), seen.append("outer")))
    executor.spin_once()
    assert seen


def test_person_is_advised_on_two_threads_that_spin(ros: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(explanations, "is_read", lambda: True)
    lines: list[str] = []
    forget = on_notice(lambda process, text: lines.append(text))
    executor = SingleThreadedExecutor(context=ros.init())
    thread, _ = _waiting_thread(executor, executor.spin)
    with pytest.raises(ValueError):
        executor.spin_once()
    forget()
    ros.context.shutdown()
    thread.join()
    assert len(lines) == 1
    assert lines[0].startswith(f"{__file__}:") and "give each thread an executor of its own" in lines[0]


def test_executor_knows_whether_it_spins(ros: Any) -> None:
    node, seen = ros.node(), []
    executor, done = node.executor, Future()
    node.create_guard_condition(lambda: (seen.append(executor.is_spinning), done.set_result(None))).trigger()
    assert not executor.is_spinning
    executor.spin_until_future_complete(done)
    assert seen == [True] and not executor.is_spinning
