"""rclpy under threads: nothing reliable is lost, nothing hangs, nothing leaks. Run with `-m soak`."""

from __future__ import annotations

import gc
import random
import threading
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import Any

import pytest
from domains import unused_domain
from example_interfaces.srv import AddTwoInts
from polling import until
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.context import Context
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import HistoryPolicy, QoSProfile
from std_msgs.msg import Int64

pytestmark = pytest.mark.soak

TIMEOUT_S = 60.0
"""Seconds that a thread may take to end before it counts as hung."""
MINUTE = 60.0
BACKLOG = 2_000
"""How many messages may wait before the senders of the stress test pause."""
KEEP_ALL = QoSProfile(history=HistoryPolicy.KEEP_ALL)


@contextmanager
def context() -> Iterator[Context]:
    """A context in a separate domain."""
    made = Context()
    made.init([], domain_id=unused_domain())
    yield made
    made.try_shutdown()


class Threads:
    """Threads that must end, and whose exceptions fail the test."""

    def __init__(self) -> None:
        self._threads: list[threading.Thread] = []
        self._errors: list[BaseException] = []

    def start(self, target: Callable[..., object], *args: Any) -> None:
        """Run something in a thread; the shutdown of its context is not an error."""

        def run() -> None:
            try:
                target(*args)
            except ExternalShutdownException:
                pass
            except BaseException as error:  # Outermost frame of the thread: the test raises it.
                self._errors.append(error)

        thread = threading.Thread(target=run, daemon=True)
        self._threads.append(thread)
        thread.start()

    def join(self, busy: float = 0.0) -> None:
        """Wait for all threads, which may work for `busy` s; fail if one hangs, and raise their exceptions."""
        end = time.monotonic() + busy + TIMEOUT_S
        for thread in self._threads:
            thread.join(max(0.0, end - time.monotonic()))
            assert not thread.is_alive(), "a thread hangs"
        if self._errors:
            raise self._errors[0]


def test_ping_pong_between_two_executors_loses_nothing() -> None:
    count, done, threads = 50_000, threading.Event(), Threads()
    with context() as ctx:
        left, right = Node("left", context=ctx), Node("right", context=ctx)
        ping, pong = left.create_publisher(Int64, "ping", 10), right.create_publisher(Int64, "pong", 10)
        right.create_subscription(Int64, "ping", pong.publish, 10)

        def again(message: Int64) -> None:
            if message.data < count:
                ping.publish(Int64(data=message.data + 1))
            else:
                done.set()

        left.create_subscription(Int64, "pong", again, 10)
        for node in (left, right):
            executor = SingleThreadedExecutor(context=ctx)
            executor.add_node(node)
            threads.start(executor.spin)
        ping.publish(Int64())
        assert done.wait(TIMEOUT_S)
        ctx.shutdown()
        threads.join()


@pytest.mark.parametrize("group", [ReentrantCallbackGroup, MutuallyExclusiveCallbackGroup])
def test_foreign_threads_lose_nothing(group: Any) -> None:
    per_thread, senders, got, threads = 5_000, 6, Counter(), Threads()
    lock = threading.Lock()

    def take(message: Int64) -> None:
        with lock:
            got[message.data] += 1

    with context() as ctx:
        node = Node("n", context=ctx)
        node.create_subscription(Int64, "t", take, KEEP_ALL, callback_group=group())
        executor = MultiThreadedExecutor(4, context=ctx)
        executor.add_node(node)
        threads.start(executor.spin)
        publishers = [
            Node(f"p{number}", context=ctx).create_publisher(Int64, "t", KEEP_ALL) for number in range(senders)
        ]

        def send(first: int) -> None:
            for number in range(per_thread):
                publishers[first].publish(Int64(data=first * per_thread + number))

        for sender in range(senders):
            threads.start(send, sender)
        until(lambda: len(got) == senders * per_thread)
        executor.shutdown()
        threads.join()
    assert set(got.values()) == {1}


def test_exclusive_group_is_exclusive_under_load() -> None:
    inside, worst, calls, threads = [0], [0], [0], Threads()
    group = MutuallyExclusiveCallbackGroup()

    def work(*_: Any) -> None:
        inside[0] += 1
        worst[0] = max(worst[0], inside[0])
        calls[0] += 1
        time.sleep(0)
        inside[0] -= 1

    with context() as ctx:
        node = Node("n", context=ctx)
        publisher = node.create_publisher(Int64, "t", KEEP_ALL)
        node.create_subscription(Int64, "t", work, KEEP_ALL, callback_group=group)
        guards = [node.create_guard_condition(work, group) for _ in range(4)]
        node.create_timer(0.0, work, group)
        executor = MultiThreadedExecutor(8, context=ctx)
        executor.add_node(node)
        threads.start(executor.spin)

        def press() -> None:
            for number in range(3_000):
                publisher.publish(Int64(data=number))
                guards[number % 4].trigger()

        for _ in range(3):
            threads.start(press)
        until(lambda: calls[0] > 12_000)
        executor.shutdown()
        threads.join()
    assert worst == [1]


def test_calls_from_many_threads_are_answered() -> None:
    per_thread, callers, threads, wrong = 1_000, 5, Threads(), []
    with context() as ctx:
        node, requester = Node("server", context=ctx), Node("asker", context=ctx)

        def add(request: Any, response: Any) -> Any:
            response.sum = request.a + request.b
            return response

        node.create_service(AddTwoInts, "add", add, callback_group=ReentrantCallbackGroup())
        client = requester.create_client(AddTwoInts, "add", callback_group=ReentrantCallbackGroup())
        executor = MultiThreadedExecutor(3, context=ctx)
        executor.add_node(node)
        executor.add_node(requester)
        threads.start(executor.spin)

        def ask(first: int) -> None:
            for number in range(per_thread):
                answer = client.call(AddTwoInts.Request(a=first, b=number), timeout_sec=TIMEOUT_S)
                if answer is None or answer.sum != first + number:
                    wrong.append((first, number, answer))

        requesters = Threads()
        for caller in range(callers):
            requesters.start(ask, caller * 1_000_000)
        requesters.join()
        executor.shutdown()
        threads.join()
    assert (wrong, client._pending_requests) == ([], {})


@pytest.mark.parametrize("kind", [SingleThreadedExecutor, MultiThreadedExecutor])
def test_shutdown_during_callbacks_ends_cleanly(kind: Any) -> None:
    for _ in range(150):
        threads = Threads()
        with context() as ctx:
            node = Node("n", context=ctx)
            publisher = node.create_publisher(Int64, "t", 10)
            node.create_subscription(Int64, "t", lambda message: None, 10)
            node.create_timer(0.0, lambda publisher=publisher: _publish(publisher))
            executor = kind(context=ctx)
            executor.add_node(node)
            threads.start(executor.spin)
            threads.start(lambda publisher=publisher: [_publish(publisher) for _ in range(50)])
            time.sleep(random.random() * 0.003)
            ctx.shutdown()
            threads.join()
            executor.shutdown()
            node.destroy_node()


def _publish(publisher: Any) -> None:
    with suppress(RuntimeError):  # The context may be shut down by now.
        publisher.publish(Int64())


def census() -> Counter[str]:
    """Count the objects of each kind."""
    gc.collect()
    return Counter(type(each).__name__ for each in gc.get_objects())


def test_a_thousand_nodes_leak_nothing() -> None:
    def live(number: int, ctx: Context) -> None:
        node = Node(f"n{number}", context=ctx)
        node.declare_parameter("p", number)
        node.create_publisher(Int64, "t", 10).publish(Int64())
        node.create_subscription(Int64, "t", lambda message: None, 10)
        node.create_timer(0.0, lambda: None)
        executor = SingleThreadedExecutor(context=ctx)
        executor.add_node(node)
        executor.spin_once(timeout_sec=0)
        executor.shutdown()
        node.destroy_node()

    with context() as ctx:
        for number in range(20):
            live(number, ctx)
        before, threads = census(), threading.active_count()
        for number in range(1_000):
            live(number, ctx)
        more = census() - before
        assert threading.active_count() == threads
        assert {name: count for name, count in more.items() if count > 20} == {}
        assert [each.nodes() for each in ctx.bus.tables()] == [[]]


@pytest.mark.timeout(300)
def test_a_minute_of_everything_leaks_nothing() -> None:
    end, threads, lock = time.monotonic() + MINUTE, Threads(), threading.Lock()
    sent: Counter[int] = Counter()
    got: Counter[int] = Counter()
    served = [0]

    def take(message: Int64) -> None:
        with lock:
            got[message.data] += 1

    with context() as ctx:
        sinks = [Node(f"sink{number}", context=ctx) for number in range(3)]
        executors = [SingleThreadedExecutor(context=ctx), MultiThreadedExecutor(4, context=ctx)]
        for number, sink in enumerate(sinks):
            sink.create_subscription(Int64, f"t{number}", take, KEEP_ALL, callback_group=ReentrantCallbackGroup())
            sink.create_service(
                AddTwoInts, f"add{number}", lambda request, response: response, callback_group=ReentrantCallbackGroup()
            )
            executors[number % 2].add_node(sink)
        for executor in executors:
            threads.start(executor.spin)

        def live(seed: int) -> None:
            dice = random.Random(seed)
            while time.monotonic() < end:
                until(lambda: len(sent) - len(got) < BACKLOG)
                node = Node(f"n{seed}", context=ctx)
                executor = dice.choice(executors)
                node.create_timer(0.001, lambda: None)
                executor.add_node(node)
                target = dice.randrange(3)
                publisher = node.create_publisher(Int64, f"t{target}", KEEP_ALL)
                for _ in range(dice.randrange(200)):
                    number = dice.getrandbits(60)
                    with lock:
                        sent[number] += 1
                    publisher.publish(Int64(data=number))
                client = node.create_client(AddTwoInts, f"add{target}", callback_group=ReentrantCallbackGroup())
                assert client.call(AddTwoInts.Request(), timeout_sec=TIMEOUT_S) is not None
                with lock:
                    served[0] += 1
                executor.remove_node(node)
                node.destroy_node()

        lives = Threads()
        for seed in range(4):
            lives.start(live, seed)
        lives.join(MINUTE)
        until(lambda: len(got) == len(sent))
        for executor in executors:
            executor.shutdown()
        threads.join()
    assert got == sent
    assert served[0] > 100
