"""Futures and tasks."""

from __future__ import annotations

import asyncio
import gc
import threading
from typing import Any

import pytest
from rclpy.task import Future, Task


def test_future_returns_its_result() -> None:
    future: Future[int] = Future()
    assert (future.done(), future.result(), future.exception(), future.cancelled()) == (False, None, None, False)
    assert future.set_result(3) is None
    assert (future.done(), future.result()) == (True, 3)
    future.set_result(4)
    assert future.result() == 4


def test_future_keeps_its_exception() -> None:
    future: Future[int] = Future()
    error = KeyError("x")
    future.set_exception(error)
    assert future.done() and future.exception() is error
    with pytest.raises(KeyError):
        future.result()


def test_cancelled_future_is_not_done_and_may_still_complete() -> None:
    future: Future[int] = Future()
    assert future.cancel() is None
    assert (future.cancelled(), future.done(), future.result()) == (True, False, None)
    future.set_result(1)
    assert (future.cancelled(), future.done(), future.result()) == (False, True, 1)
    future.cancel()
    assert not future.cancelled()


def test_done_callbacks_run_in_order() -> None:
    future, got = Future(), []
    future.add_done_callback(lambda each: got.append(("first", each is future)))
    future.add_done_callback(lambda each: got.append(("second", each.result())))
    future.set_result(5)
    future.add_done_callback(lambda each: got.append(("late", each.result())))
    assert got == [("first", True), ("second", 5), ("late", 5)]


def test_cancel_runs_done_callbacks() -> None:
    future, got = Future(), []
    future.add_done_callback(lambda each: got.append(each.cancelled()))
    future.cancel()
    assert got == [True]


def test_failing_done_callback_does_not_stop_the_next() -> None:
    future, got = Future(), []
    future.add_done_callback(lambda each: {}["missing"])
    future.add_done_callback(lambda each: got.append("next"))
    with pytest.warns(UserWarning, match="missing"):
        future.set_result(1)
    assert got == ["next"]


def test_done_callback_can_be_removed() -> None:
    future, got = Future(), []
    future.add_done_callback(got.append)
    assert future.remove_done_callback(got.append) and not future.remove_done_callback(print)
    future.set_result(1)
    assert got == []


def test_done_callback_added_twice_is_removed_once() -> None:
    future: Future[int] = Future()
    got: list[Any] = []
    future.add_done_callback(got.append)
    future.add_done_callback(got.append)
    assert future.remove_done_callback(got.append)
    future.set_result(1)
    assert got == [future]


def test_done_callback_added_after_cancel_runs_at_once() -> None:
    future: Future[int] = Future()
    got: list[Any] = []
    future.cancel()
    future.add_done_callback(got.append)
    assert got == [future]


def test_unretrieved_exception_is_reported(capsys: pytest.CaptureFixture[str]) -> None:
    future: Any = Future()
    future.set_exception(RuntimeError("forgotten"))
    del future
    gc.collect()
    assert "The following exception was never retrieved: forgotten" in capsys.readouterr().err


def test_awaiting_yields_until_the_future_is_done() -> None:
    future: Future[int] = Future()

    async def wait() -> Any:
        return await future

    coroutine = wait()
    assert coroutine.send(None) is None
    assert coroutine.send(None) is None
    future.set_result(7)
    with pytest.raises(StopIteration) as ended:
        coroutine.send(None)
    assert ended.value.value == 7


@pytest.mark.parametrize("work", [lambda a, b: a + b, None])
def test_task_runs_a_function_or_coroutine(work: Any) -> None:
    async def add(a: int, b: int) -> int:
        return a + b

    task: Task[int] = Task(work or add, (1,), {"b": 2})
    assert not task.executing()
    task()
    assert (task.done(), task.result()) == (True, 3)
    task()
    assert task.result() == 3


def test_task_keeps_its_exception() -> None:
    task: Task[None] = Task(lambda: {}["x"])
    task()
    assert isinstance(task.exception(), KeyError)


def test_done_callbacks_run_in_the_executor(ros: Any) -> None:
    executor, got = ros.node().executor, []
    task = executor.create_task(lambda: 1)
    task.add_done_callback(lambda each: got.append(each.result()))
    executor.spin_once()
    assert got == []
    executor.spin_once()
    assert got == [1]


def test_cancelled_task_does_not_run(ros: Any) -> None:
    executor, got = ros.node().executor, []
    task = executor.create_task(got.append, 1)
    task.cancel()
    assert (task.cancelled(), task.done()) == (True, False)
    executor.spin_once(timeout_sec=0)
    assert (got, task.cancelled(), task.done()) == ([], True, False)


def test_future_set_by_another_thread_can_be_awaited(ros: Any) -> None:
    node, future, got = ros.node(), Future(), []

    async def wait() -> None:
        got.append(await future)

    task = node.executor.create_task(wait)
    node.executor.spin_once()
    thread = threading.Thread(target=future.set_result, args=(9,))
    thread.start()
    node.executor.spin_until_future_complete(task, 20.0)
    thread.join()
    assert got == [9]


def test_nested_coroutines_are_awaited(ros: Any) -> None:
    node, inner, got = ros.node(), Future(), []

    async def deep() -> int:
        return 1 + (await inner or 0)

    async def outer() -> None:
        got.append(await deep() + await deep())

    task = node.executor.create_task(outer)
    node.executor.spin_once()
    inner.set_result(20)
    node.executor.spin_until_future_complete(task, 20.0)
    assert got == [42]


def test_cancelled_coroutine_does_not_run_and_executor_continues(ros: Any) -> None:
    executor, got = ros.node().executor, []

    async def work() -> None:
        got.append("ran")

    task = executor.create_task(work)
    task.cancel()
    executor.spin_once(timeout_sec=0)
    assert (got, task.done(), task.cancelled()) == ([], False, True)


def test_coroutine_cancelled_while_waiting_is_closed_once(ros: Any) -> None:
    executor, got = ros.node().executor, []
    awaited: Future[int] = Future()

    async def work() -> None:
        try:
            await awaited
        finally:
            got.append("closed")

    task = executor.create_task(work)
    executor.spin_once(timeout_sec=0)
    task.cancel()
    awaited.set_result(1)
    executor.spin_once(timeout_sec=0.1)
    assert (got, task.done(), task.cancelled()) == (["closed"], False, True)


@pytest.mark.parametrize("before", [True, False])
def test_awaiting_a_cancelled_future_returns_none(ros: Any, before: bool) -> None:
    executor, got = ros.node().executor, []
    awaited: Future[int] = Future()

    async def work() -> None:
        got.append(await awaited)

    if before:
        awaited.cancel()
    task = executor.create_task(work)
    executor.spin_once(timeout_sec=0)
    awaited.cancel()
    executor.spin_once(timeout_sec=0.1)
    assert (got, task.done()) == ([None], True)


@pytest.mark.parametrize("timeout", [None, 1000.0])
def test_spin_until_future_complete_ends_on_cancel(ros: Any, timeout: float | None) -> None:
    executor = ros.node().executor
    future: Future[int] = Future()
    executor.create_task(future.cancel)
    executor.spin_until_future_complete(future, timeout)
    assert future.cancelled() and not future.done()


def test_coroutine_cannot_cancel_itself(ros: Any) -> None:
    executor = ros.node().executor

    async def work() -> None:
        task.cancel()

    task = executor.create_task(work)
    with pytest.raises(ValueError, match="already executing"):
        executor.spin_once(timeout_sec=0)


def test_exception_of_an_awaited_future_leaves_spin(ros: Any) -> None:
    executor, go = ros.node().executor, Future()

    async def work() -> None:
        await go

    task = executor.create_task(work)
    executor.spin_once(timeout_sec=1.0)
    go.set_exception(KeyError("lost"))
    with pytest.raises(KeyError, match="lost"):
        executor.spin_once(timeout_sec=1.0)
    assert task.done() and isinstance(task.exception(), KeyError)


def test_exception_behind_several_waits_is_not_hidden(ros: Any) -> None:
    executor = ros.node().executor
    gates: list[Future[int]] = [Future() for _ in range(3)]

    async def inner(gate: Future[int]) -> int:
        value = await gate
        if value == 2:
            raise LookupError("third")
        return value or 0

    async def outer() -> list[int]:
        return [await inner(each) for each in gates]

    task = executor.create_task(outer)
    for number, gate in enumerate(gates):
        executor.spin_once(timeout_sec=1.0)
        gate.set_result(number)
    with pytest.raises(LookupError, match="third"):
        executor.spin_once(timeout_sec=1.0)
    assert task.done()


def test_task_awaits_another_task(ros: Any) -> None:
    executor = ros.node().executor

    async def inner() -> int:
        return 3

    async def outer() -> int:
        return 1 + ((await executor.create_task(inner)) or 0)

    task = executor.create_task(outer)
    executor.spin_until_future_complete(task, timeout_sec=5.0)
    assert task.result() == 4


def test_done_future_is_awaited_without_a_pause(ros: Any) -> None:
    executor, done = ros.node().executor, Future()
    done.set_result(5)

    async def work() -> Any:
        return await done

    task = executor.create_task(work)
    executor.spin_once(timeout_sec=1.0)
    assert task.result() == 5


def test_asyncio_awaits_a_future_of_rclpy() -> None:
    """This fails with rclpy 7.1.9 (rclpy#1588)."""
    future: Future[int] = Future()

    async def main() -> Any:
        asyncio.get_running_loop().call_later(0.01, future.set_result, 8)
        return await future

    assert asyncio.run(main()) == 8
