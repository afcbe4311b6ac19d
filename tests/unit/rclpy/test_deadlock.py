"""A wait inside a callback that can never end is reported, with its line, cause and remedy."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from bot_console.runtime.process import on_notice
from example_interfaces.action import Fibonacci
from rclpy import timer
from rclpy.action import ActionClient
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from std_srvs.srv import Trigger

GROUP = "waits in vain: it was called in a callback of a MutuallyExclusiveCallbackGroup of /n"
THREAD = "the SingleThreadedExecutor that runs this callback"
SOON_S = 0.01


@pytest.fixture
def notices() -> Iterator[list[str]]:
    lines: list[str] = []
    forget = on_notice(lambda process, text: lines.append(text))
    yield lines
    forget()


class System:
    """A node with a callback, and a server in another node served by the same executor."""

    def __init__(self, ros: Any, executor: Any, client_group: Any = None) -> None:
        self.ros, self.executor = ros, executor
        self.node, self.server = ros.node("n"), ros.node("server")
        self.server.create_service(Trigger, "go", lambda request, response: response)
        self.client = self.node.create_client(Trigger, "go", callback_group=client_group)
        for each in (self.node, self.server):
            executor.add_node(each)

    def run(self, callback: Callable[[], object], group: Any = None) -> None:
        """Call the function once from a timer, and spin until it has ended."""
        done = threading.Event()

        def once() -> None:
            calls.cancel()
            try:
                callback()
            finally:
                done.set()

        calls = self.node.create_timer(0.0, once, callback_group=group)
        while not done.is_set():
            self.executor.spin_once(timeout_sec=0.1)

    def call(self) -> Any:
        return self.client.call(Trigger.Request(), timeout_sec=SOON_S)


@pytest.fixture
def multi(ros: Any) -> Iterator[Any]:
    with MultiThreadedExecutor(4, context=ros.init()) as executor:
        yield executor


def test_call_in_a_callback_of_the_default_group_is_reported(ros: Any, multi: Any, notices: list[str]) -> None:
    system = System(ros, multi)
    got: list[Any] = []
    system.run(lambda: got.append(system.call()))
    assert got == [None], "as in rclpy"
    assert len(notices) == 1
    assert notices[0].startswith(f"{__file__}:") and GROUP in notices[0]
    assert "(the default one)" in notices[0] and "a call of /go" in notices[0]


def test_call_in_a_callback_of_the_same_exclusive_group_is_reported(ros: Any, multi: Any, notices: list[str]) -> None:
    group = MutuallyExclusiveCallbackGroup()
    system = System(ros, multi, group)
    system.run(system.call, group)
    assert len(notices) == 1
    assert GROUP in notices[0] and "default" not in notices[0]


def test_call_in_a_callback_of_a_single_threaded_executor_is_reported(ros: Any, notices: list[str]) -> None:
    system = System(ros, SingleThreadedExecutor(context=ros.init()), ReentrantCallbackGroup())
    system.run(system.call)
    assert len(notices) == 1 and THREAD in notices[0]


def test_spinning_for_a_future_in_a_callback_of_the_same_group_is_reported(ros: Any, notices: list[str]) -> None:
    system = System(ros, SingleThreadedExecutor(context=ros.init()))
    system.run(
        lambda: system.executor.spin_until_future_complete(
            system.client.call_async(Trigger.Request()), timeout_sec=SOON_S
        )
    )
    assert len(notices) == 1
    assert "spinning until a future is complete" in notices[0] and GROUP in notices[0]


def test_spinning_for_a_goal_in_a_callback_of_the_same_group_is_reported(ros: Any, notices: list[str]) -> None:
    system = System(ros, SingleThreadedExecutor(context=ros.init()))
    client = ActionClient(system.node, Fibonacci, "count")
    system.run(
        lambda: system.executor.spin_until_future_complete(client.send_goal_async(Fibonacci.Goal()), timeout_sec=SOON_S)
    )
    assert len(notices) == 1 and GROUP in notices[0] and "the action client" in notices[0]


def test_call_on_a_node_without_executor_is_reported(ros: Any, notices: list[str]) -> None:
    system = System(ros, SingleThreadedExecutor(context=ros.init()))
    system.executor.remove_node(system.node)
    assert system.call() is None
    assert len(notices) == 1 and "no executor spins the node /n" in notices[0]


def test_rate_sleep_in_a_callback_of_a_single_threaded_executor_is_reported(
    ros: Any, notices: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(timer, "WARNING_DELAY_NS", 1)
    system = System(ros, SingleThreadedExecutor(context=ros.init()))
    rate = system.node.create_rate(0.001)  # no tick comes before the sleep, however busy the machine is
    forget = on_notice(lambda process, text: rate.destroy())
    system.run(rate.sleep)
    forget()
    assert len(notices) == 1 and "sleep() of a rate" in notices[0] and THREAD in notices[0]


def test_waits_that_can_end_are_not_reported(ros: Any, multi: Any, notices: list[str]) -> None:
    """A separate group, a thread of the program, and a server that is late."""
    system = System(ros, multi, MutuallyExclusiveCallbackGroup())
    missing = system.node.create_client(Trigger, "none", callback_group=ReentrantCallbackGroup())
    system.run(lambda: system.client.call(Trigger.Request()))
    system.run(lambda: missing.call(Trigger.Request(), timeout_sec=SOON_S))
    thread = threading.Thread(target=lambda: missing.call(Trigger.Request(), timeout_sec=SOON_S))
    system.run(lambda: (thread.start(), thread.join()))
    assert notices == []
