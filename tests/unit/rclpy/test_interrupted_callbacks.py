"""A callback that is interrupted (Ctrl-C, SystemExit ...) leaves spin, and its callback group is free again."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import Any

import pytest
from action_tutorials_interfaces.action import Fibonacci
from rclpy.action import ActionClient, ActionServer
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.task import Future, Task
from std_msgs.msg import Int32
from std_srvs.srv import Trigger

Interrupt = type[BaseException]
INTERRUPTS: tuple[Interrupt, ...] = (KeyboardInterrupt, SystemExit, asyncio.CancelledError, GeneratorExit)


def _guard(ros: Any, node: Any, callback: Callable[[], Any]) -> None:
    node.create_guard_condition(callback).trigger()


def _timer(ros: Any, node: Any, callback: Callable[[], Any]) -> None:
    node.create_timer(0.0, callback)


def _subscription(ros: Any, node: Any, callback: Callable[[], Any]) -> None:
    async def received(message: Int32) -> None:
        await callback()

    node.create_subscription(Int32, "t", received, 10)
    node.create_publisher(Int32, "t", 10).publish(Int32())


def _service(ros: Any, node: Any, callback: Callable[[], Any]) -> None:
    async def answer(request: Any, response: Any) -> Any:
        await callback()
        return response

    node.create_service(Trigger, "s", answer)
    node.create_client(Trigger, "s").call_async(Trigger.Request())


def _goal(ros: Any, node: Any, callback: Callable[[], Any]) -> None:
    async def execute(goal: Any) -> Any:
        await callback()
        return Fibonacci.Result()

    node.fibonacci = ActionServer(node, Fibonacci, "fibonacci", execute)
    ActionClient(node, Fibonacci, "fibonacci").send_goal_async(Fibonacci.Goal())


ENTITIES = {"guard": _guard, "timer": _timer, "subscription": _subscription, "service": _service, "goal": _goal}


@pytest.mark.parametrize("when", ["at once", "after a wait", "in a nested coroutine"])
@pytest.mark.parametrize("interrupt", INTERRUPTS)
@pytest.mark.parametrize("entity", ENTITIES)
def test_interrupt_in_a_coroutine_callback_leaves_its_group_free(
    ros: Any, entity: str, interrupt: Interrupt, when: str
) -> None:
    node, go, got = ros.node(), Future(), []

    async def inner() -> None:
        raise interrupt

    async def callback() -> None:
        if when == "after a wait":
            await go
        if when == "in a nested coroutine":
            await inner()
        raise interrupt

    ENTITIES[entity](ros, node, callback)
    go.set_result(None)
    with pytest.raises(interrupt):
        ros.spin(lambda: False)
    assert node.default_callback_group.can_execute(None)
    node.create_guard_condition(lambda: got.append("next")).trigger()
    try:
        ros.spin(lambda: bool(got))
    except interrupt:  # the timer is due again, and comes first
        ros.spin(lambda: bool(got))


@pytest.mark.parametrize("interrupt", INTERRUPTS)
def test_interrupted_task_is_forgotten(ros: Any, interrupt: Interrupt) -> None:
    async def work() -> None:
        raise interrupt

    executor = ros.node().executor
    task = executor.create_task(work)
    with pytest.raises(interrupt):
        executor.spin_once(timeout_sec=1.0)
    assert not task.done() and task not in executor._tasks


def test_interrupted_task_may_be_called_again_without_effect() -> None:
    async def work() -> None:
        raise KeyboardInterrupt

    task: Task[None] = Task(work)
    with pytest.raises(KeyboardInterrupt):
        task()
    task()
    assert not task.done() and task.exception() is None


@pytest.mark.parametrize("kind", [SingleThreadedExecutor, lambda context: MultiThreadedExecutor(2, context=context)])
def test_interrupted_coroutine_does_not_block_group_in_any_executor(ros: Any, kind: Any) -> None:
    node, got = ros.node(), []
    node.executor.remove_node(node)
    executor = kind(context=ros.context)
    executor.add_node(node)

    async def leave() -> None:
        got.append("leaves")
        guard.trigger()
        raise SystemExit(3)

    def answer() -> None:
        got.append("next")

    guard = node.create_guard_condition(answer)
    node.create_guard_condition(leave).trigger()
    for _ in range(1000):
        try:
            executor.spin_once(timeout_sec=0.01)
        except SystemExit:
            continue
        if "next" in got:
            break
    executor.shutdown()
    assert got == ["leaves", "next"]
