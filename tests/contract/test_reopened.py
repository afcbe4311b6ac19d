"""A session is reopened without its node noticing: no call raises, and afterwards everything works as before."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import suppress
from typing import Any

import pytest
from bot_console.runtime.rmw.zenoh.bus import ZenohBus
from bot_console.runtime.rmw.zenoh.domain.mesh import MeshSession
from bot_console.runtime.rmw.zenoh.session import SessionError
from example_interfaces.action import Fibonacci
from helpers.processes.two_processes import Here, two_processes
from rclpy.action import ActionClient, ActionServer
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile
from std_msgs.msg import String
from std_srvs.srv import Trigger

TIMES = 5
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
ALL = QoSProfile(history=HistoryPolicy.KEEP_ALL, depth=0)


@pytest.fixture
def here(tmp_path) -> Iterator[Here]:
    with two_processes(tmp_path / "s") as (system, _):
        yield system


def session_of(here: Here) -> MeshSession:
    bus = here.context.bus
    assert isinstance(bus, ZenohBus) and isinstance(bus._session, MeshSession)
    return bus._session


def while_reopened(here: Here, call: Callable[[], None], times: int = TIMES) -> None:
    """Repeat a call in this thread while another thread reopens the session, each at least `times` times.

    How long either takes depends on the machine.
    """
    called = opened = 0
    done = threading.Event()

    def reopen() -> None:
        nonlocal opened
        try:
            while opened < times or called < times:
                with suppress(SessionError):  # the closed session still holds its socket: the watch tries again, too
                    session_of(here).rejoin(lambda folder: True)
                    opened += 1
        finally:
            done.set()

    thread = threading.Thread(target=reopen, daemon=True)
    thread.start()
    while not done.is_set():
        call()
        called += 1
    thread.join()
    assert opened >= times, "the session could not be opened"


@pytest.mark.slow
def test_no_call_of_a_node_raises(here: Here) -> None:
    node = here.node
    output = [node.create_publisher(String, "/said", qos) for qos in (10, LATCHED, ALL)]
    pull = node.create_client(Trigger, "/pull")
    here.until(pull.service_is_ready)

    def all_calls() -> None:
        for publisher in output:
            publisher.publish(String(data="x"))
            publisher.get_subscription_count()
        pull.call_async(Trigger.Request())
        pull.service_is_ready()
        made: list[Any] = [
            node.create_publisher(String, "/made", LATCHED),
            node.create_publisher(String, "/made", 10),
            node.create_subscription(String, "/made", lambda _: None, LATCHED),
            node.create_service(Trigger, "/made_service", lambda _, response: response),
            node.create_client(Trigger, "/pull"),
        ]
        made[0].publish(String(data="x"))
        made[4].call_async(Trigger.Request())
        action = ActionServer(node, Fibonacci, "/made_action", lambda goal: Fibonacci.Result())
        client = ActionClient(node, Fibonacci, "/made_action")
        node.get_topic_names_and_types()
        node.count_publishers("/echo")
        here.executor.spin_once(timeout_sec=0)
        client.destroy()
        action.destroy()
        for each, destroy in zip(
            made,
            (
                node.destroy_publisher,
                node.destroy_publisher,
                node.destroy_subscription,
                node.destroy_service,
                node.destroy_client,
            ),
            strict=True,
        ):
            assert destroy(each)

    while_reopened(here, all_calls)
    here.until(lambda: here.node.count_publishers("/echo") == 1)
    assert here.result(pull.call_async(Trigger.Request())).message == "pulled"


def test_requests_and_reliable_messages_sent_meanwhile_arrive(here: Here) -> None:
    heard: list[str] = []
    here.node.create_subscription(String, "/echo", lambda message: heard.append(message.data), 1000)
    show_text = here.node.create_publisher(String, "/say", ALL)
    pull = here.node.create_client(Trigger, "/pull")
    here.until(
        lambda: pull.service_is_ready() and show_text.get_subscription_count() and here.node.count_publishers("/echo")
    )
    asked: list[Any] = []
    session, join = session_of(here), session_of(here)._join

    def joining(folder: str) -> None:
        """The state between closing the old session and opening the new one."""
        asked.append(pull.call_async(Trigger.Request()))
        show_text.publish(String(data="meanwhile"))
        join(folder)

    session._join = joining
    session.rejoin(lambda folder: True)
    assert here.result(asked[0]).message == "pulled"
    here.until(lambda: "meanwhile" in heard)


def test_nothing_raises_while_the_session_cannot_be_opened(here: Here) -> None:
    session, join = session_of(here), session_of(here)._join
    pull = here.node.create_client(Trigger, "/pull")
    here.until(pull.service_is_ready)
    show_text = here.node.create_publisher(String, "/say", LATCHED)

    def refused(folder: str) -> None:
        raise SessionError("no")

    session._join = refused
    with pytest.raises(SessionError):
        session.rejoin(lambda folder: True)
    made = here.node.create_publisher(String, "/made", LATCHED)
    taken_back = here.node.create_subscription(String, "/echo", lambda _: None, 10)
    for publisher in (show_text, made):
        publisher.publish(String(data="x"))
    assert here.node.destroy_subscription(taken_back)
    asked = pull.call_async(Trigger.Request())
    assert here.node.count_publishers("/echo") == 0  # unreachable endpoints are not shown
    session._join = join
    session.rejoin(lambda folder: True)
    assert here.result(asked).message == "pulled"
    here.until(lambda: here.node.count_publishers("/echo") == 1)


def test_a_process_that_ends_meanwhile_leaves_the_graph(tmp_path) -> None:
    with two_processes(tmp_path / "s", peers=2) as (here, peers):
        session, join = session_of(here), session_of(here)._join

        def joining(folder: str) -> None:
            peers[1].kill()
            peers[1].wait()
            join(folder)

        session._join = joining
        session.rejoin(lambda folder: True)
        here.until(lambda: here.node.count_publishers("/echo") == 1)
