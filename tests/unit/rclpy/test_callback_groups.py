"""Which callbacks may run at the same time."""

from __future__ import annotations

import threading
from collections import Counter
from typing import Any

import pytest
from rclpy.callback_groups import CallbackGroup, MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.task import Future
from std_msgs.msg import Int32

TIMEOUT_S = 240.0


def test_entities_belong_to_their_group(ros: Any) -> None:
    node, group = ros.node(), ReentrantCallbackGroup()
    guard = node.create_guard_condition(None, group)
    other = node.create_guard_condition(None)
    assert group.has_entity(guard) and not group.has_entity(other)
    assert node.default_callback_group.has_entity(other)
    assert isinstance(node.default_callback_group, MutuallyExclusiveCallbackGroup)


def test_mutually_exclusive_group_lets_one_callback_begin() -> None:
    group, first, second = MutuallyExclusiveCallbackGroup(), object(), object()
    assert group.can_execute(first) and group.beginning_execution(first)
    assert not group.can_execute(second) and not group.beginning_execution(second)
    assert not group.beginning_execution(first)
    group.ending_execution(second)
    assert not group.can_execute(second), "only the one that runs can end"
    group.ending_execution(first)
    assert group.beginning_execution(second)


def test_reentrant_group_lets_all_callbacks_begin() -> None:
    group = ReentrantCallbackGroup()
    assert group.beginning_execution(1) and group.beginning_execution(1) and group.can_execute(2)


def test_base_class_is_abstract() -> None:
    with pytest.raises(NotImplementedError):
        CallbackGroup().can_execute(None)


class Overlap:
    """Callbacks that wait for each other until the requested number run together."""

    def __init__(self, ros: Any, groups: list[Any], threads: int = 4) -> None:
        self.peak = self.active = self.calls = 0
        self._lock = threading.Lock()
        self._leave = threading.Event()
        self.together = threading.Event()
        node = ros.node()
        self._executor = MultiThreadedExecutor(threads, context=ros.context)
        self._executor.add_node(node)
        for group in groups:
            node.create_guard_condition(self._work, group).trigger()

    def _work(self) -> None:
        with self._lock:
            self.active += 1
            self.calls += 1
            self.peak = max(self.peak, self.active)
            if self.active == self.wanted:
                self.together.set()
        self._leave.wait(TIMEOUT_S)
        with self._lock:
            self.active -= 1

    def run(self, wanted: int, calls: int) -> int:
        """Return how many ran together at most."""
        self.wanted = wanted
        thread = threading.Thread(target=self._executor.spin, daemon=True)
        thread.start()
        assert self.together.wait(TIMEOUT_S)
        self._leave.set()
        while self.calls < calls or self.active:
            assert thread.is_alive()
        self._executor.shutdown()
        thread.join(TIMEOUT_S)
        return self.peak


def test_callbacks_of_two_exclusive_groups_overlap(ros: Any) -> None:
    assert Overlap(ros, [MutuallyExclusiveCallbackGroup(), MutuallyExclusiveCallbackGroup()]).run(2, 2) == 2


def test_callbacks_of_one_exclusive_group_do_not_overlap(ros: Any) -> None:
    group = MutuallyExclusiveCallbackGroup()
    assert Overlap(ros, [group, group, group]).run(1, 3) == 1


def test_callbacks_of_a_reentrant_group_overlap(ros: Any) -> None:
    group = ReentrantCallbackGroup()
    assert Overlap(ros, [group, group, group]).run(3, 3) == 3


def test_group_may_span_nodes_and_executors(ros: Any) -> None:
    group, got = MutuallyExclusiveCallbackGroup(), []
    first, second = ros.node("first"), ros.node("second")
    other = MultiThreadedExecutor(2, context=ros.context)
    other.add_node(second)
    go = Future()

    async def hold() -> None:
        await go
        got.append("first")

    first.create_guard_condition(hold, group).trigger()
    done = threading.Event()
    second.create_guard_condition(lambda: (got.append("second"), done.set()), group).trigger()
    first.executor.spin_once()
    other.spin_once(timeout_sec=0)
    assert got == []
    go.set_result(None)
    first.executor.spin_once()
    other.spin_once(timeout_sec=TIMEOUT_S)
    assert done.wait(TIMEOUT_S)
    other.shutdown()
    assert got == ["first", "second"]


class OwnExclusiveGroup(CallbackGroup):
    """A group of the program's own, with one callback at a time."""

    def __init__(self) -> None:
        super().__init__()
        self._busy = threading.Lock()

    def can_execute(self, entity: Any) -> bool:
        return not self._busy.locked()

    def beginning_execution(self, entity: Any) -> bool:
        return self._busy.acquire(blocking=False)

    def ending_execution(self, entity: Any) -> None:
        self._busy.release()


@pytest.mark.parametrize("kind", [MutuallyExclusiveCallbackGroup, OwnExclusiveGroup])
def test_timers_that_are_always_due_do_not_starve_the_others_of_their_group(ros: Any, kind: Any) -> None:
    node, group, calls = ros.node(), kind(), Counter[str]()
    executor = MultiThreadedExecutor(2, context=ros.context)
    executor.add_node(node)
    publisher = node.create_publisher(Int32, "t", 10)
    node.create_timer(0.0, lambda: (calls.update(["first"]), publisher.publish(Int32())), group)
    node.create_timer(0.0, lambda: calls.update(["second"]), group)
    node.create_subscription(Int32, "t", lambda message: calls.update(["message"]), 10, callback_group=group)
    guard = node.create_guard_condition(lambda: calls.update(["guard"]), group)
    guard.trigger()
    while len(calls) < 4 and calls["first"] < 1000:
        executor.spin_once()
    executor.shutdown()
    assert set(calls) == {"first", "second", "message", "guard"}


def test_waiting_coroutine_keeps_its_exclusive_group(ros: Any) -> None:
    node, go, got = ros.node(), Future(), []

    async def take(message: Int32) -> None:
        got.append(("start", message.data))
        await go
        got.append(("end", message.data))

    node.create_subscription(Int32, "t", take, 10)
    publisher = node.create_publisher(Int32, "t", 10)
    for number in (1, 2):
        publisher.publish(Int32(data=number))
    ros.settle()
    assert got == [("start", 1)]
    go.set_result(None)
    ros.spin(lambda: len(got) >= 4)
    assert got == [("start", 1), ("end", 1), ("start", 2), ("end", 2)]


def test_waiting_coroutine_leaves_a_reentrant_group_free(ros: Any) -> None:
    node, go, got = ros.node(), Future(), []

    async def take(message: Int32) -> None:
        got.append(("start", message.data))
        await go
        got.append(("end", message.data))

    node.create_subscription(Int32, "t", take, 10, callback_group=ReentrantCallbackGroup())
    publisher = node.create_publisher(Int32, "t", 10)
    for number in (1, 2):
        publisher.publish(Int32(data=number))
    ros.spin(lambda: len(got) >= 2)
    assert got == [("start", 1), ("start", 2)]
    go.set_result(None)
    ros.spin(lambda: len(got) >= 4)


class Member:
    """A member of a group."""


def test_group_forgets_deleted_entities() -> None:
    group, kept = ReentrantCallbackGroup(), [Member() for _ in range(100)]
    for each in kept:
        group.add_entity(each)
    for _ in range(2000):
        group.add_entity(Member())
    assert len(group.entities) <= 2 * len(kept), "a node that makes a timer each second would grow forever"
    assert all(map(group.has_entity, kept))
