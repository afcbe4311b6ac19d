"""Executors and callback groups defined by a program."""

from __future__ import annotations

from typing import Any

import pytest
from rclpy.callback_groups import CallbackGroup
from rclpy.executors import ConditionReachedException, Executor, TimeoutException, TimeoutObject
from std_msgs.msg import Int32


class OneAtATime(Executor):
    """Runs what `wait_for_ready_callbacks` yields, and records where it came from."""

    def __init__(self, context: Any) -> None:
        super().__init__(context=context)
        self.origins: list[tuple[Any, Any]] = []

    def spin_once(self, timeout_sec: float | None = None) -> None:
        handler, entity, node = self.wait_for_ready_callbacks(timeout_sec=timeout_sec)
        self.origins.append((entity, node))
        handler()
        handler.result()


class Tickets(CallbackGroup):
    """Lets callbacks begin while there are tickets."""

    def __init__(self, count: int) -> None:
        super().__init__()
        self.count = count

    def can_execute(self, entity: Any) -> bool:
        return self.count > 0

    def beginning_execution(self, entity: Any) -> bool:
        self.count -= 1
        return True

    def ending_execution(self, entity: Any) -> None:
        pass


@pytest.fixture
def executor(ros: Any) -> OneAtATime:
    return OneAtATime(ros.init())


def test_ready_callbacks_come_with_entity_and_node(ros: Any, executor: OneAtATime) -> None:
    node, got = ros.node("own"), []
    executor.add_node(node)
    subscription = node.create_subscription(Int32, "t", got.append, 10)
    node.create_publisher(Int32, "t", 10).publish(Int32(data=4))
    executor.spin_once(timeout_sec=5)
    assert [each.data for each in got] == [4]
    assert executor.origins == [(subscription, node)]


def test_task_has_neither_entity_nor_node(executor: OneAtATime) -> None:
    task = executor.create_task(lambda: 7)
    executor.spin_once(timeout_sec=5)
    assert (task.result(), executor.origins) == (7, [(None, None)])


def test_exception_of_a_callback_is_kept_by_the_task(ros: Any, executor: OneAtATime) -> None:
    node = ros.node("own")
    executor.add_node(node)
    node.create_timer(0.0, lambda: 1 // 0)
    with pytest.raises(ZeroDivisionError):
        executor.spin_once(timeout_sec=5)


def test_coroutine_callback_continues_when_its_future_is_done(ros: Any, executor: OneAtATime) -> None:
    node, got = ros.node("own"), []
    executor.add_node(node)
    awaited = executor.create_task(lambda: "done")

    async def callback(message: Int32) -> None:
        got.append(await awaited)

    node.create_subscription(Int32, "t", callback, 10)
    node.create_publisher(Int32, "t", 10).publish(Int32())
    while not got:
        executor.spin_once(timeout_sec=5)
    assert got == ["done"]


def test_only_requested_nodes_are_served(ros: Any, executor: OneAtATime) -> None:
    wanted, other = ros.node("wanted"), ros.node("other")
    for node in (other, wanted):
        executor.add_node(node)
        node.create_guard_condition(lambda: None).trigger()
    assert executor.wait_for_ready_callbacks(timeout_sec=5, nodes=[wanted])[2] is wanted
    assert executor.wait_for_ready_callbacks(timeout_sec=5)[2] is other


def test_timer_of_another_node_stays_due(ros: Any, executor: OneAtATime) -> None:
    wanted, other = ros.node("wanted"), ros.node("other")
    for node in (other, wanted):
        executor.add_node(node)
    timer = other.create_timer(0.001, lambda: None)
    wanted.create_timer(0.01, lambda: None)
    assert executor.wait_for_ready_callbacks(timeout_sec=5, nodes=[wanted])[2] is wanted
    assert executor.wait_for_ready_callbacks(timeout_sec=5)[1] is timer


def test_timeout_and_condition_end_the_wait(executor: OneAtATime) -> None:
    with pytest.raises(TimeoutException):
        executor.wait_for_ready_callbacks(timeout_sec=TimeoutObject(0))
    with pytest.raises(ConditionReachedException):
        executor.wait_for_ready_callbacks(condition=lambda: True)


def test_custom_group_is_asked_again_at_each_wake(ros: Any) -> None:
    node, got, group = ros.node("own"), [], Tickets(1)
    node.create_subscription(Int32, "t", lambda message: got.append(message.data), 10, callback_group=group)
    publisher = node.create_publisher(Int32, "t", 10)
    for number in range(3):
        publisher.publish(Int32(data=number))
    ros.settle()
    assert got == [0]
    node.create_guard_condition(lambda: setattr(group, "count", 2)).trigger()
    ros.spin(lambda: len(got) == 3)
    assert got == [0, 1, 2]


def test_future_of_the_executor_calls_back_in_the_executor(executor: OneAtATime) -> None:
    future, got = executor.create_future(), []
    future.add_done_callback(lambda done: got.append(done.result()))
    future.set_result(3)
    assert got == []
    executor.spin_once(timeout_sec=5)
    assert got == [3]


def test_can_execute_asks_the_group(ros: Any, executor: OneAtATime) -> None:
    group = Tickets(1)
    guard = ros.node("own").create_guard_condition(lambda: None, callback_group=group)
    assert executor.can_execute(guard)
    group.count = 0
    assert not executor.can_execute(guard)
