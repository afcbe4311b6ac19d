"""Services and clients."""

from __future__ import annotations

import threading
from typing import Any

import pytest
from example_interfaces.srv import AddTwoInts
from rclpy._rclpy_pybind11 import InvalidHandle, RCLError
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from std_srvs.srv import Trigger

TIMEOUT_S = 240.0


def add(request: Any, response: Any) -> Any:
    """The service callback of most tests."""
    response.sum = request.a + request.b
    return response


class Pair:
    """A server and a client in separate nodes."""

    def __init__(self, ros: Any, callback: Any = add) -> None:
        self.ros = ros
        self.server = ros.node("server")
        self.service = self.server.create_service(AddTwoInts, "add", callback)
        self.node = ros.node("client")
        self.client = self.node.create_client(AddTwoInts, "add")

    def ask(self, a: int, b: int) -> Any:
        """Return the response."""
        future = self.client.call_async(AddTwoInts.Request(a=a, b=b))
        self.ros.spin(future.done)
        return future.result()


def test_service_responds(ros: Any) -> None:
    assert Pair(ros).ask(2, 3) == AddTwoInts.Response(sum=5)


def test_responses_reach_their_callers(ros: Any) -> None:
    pair = Pair(ros)
    other = pair.node.create_client(AddTwoInts, "add")
    asked = [(client, number) for number in range(5) for client in (pair.client, other)]
    futures = [client.call_async(AddTwoInts.Request(a=number, b=0)) for client, number in asked]
    ros.spin(lambda: all(future.done() for future in futures))
    assert [future.result().sum for future in futures] == [number for _, number in asked]


async def multiply(request: Any, response: Any) -> Any:
    """A service callback that is a coroutine."""
    response.sum = request.a * request.b
    return response


@pytest.mark.parametrize(
    ("callback", "result"), [(multiply, 42), (lambda request, response: AddTwoInts.Response(sum=99), 99)]
)
def test_callback_may_be_any_callable_or_coroutine(ros: Any, callback: Any, result: int) -> None:
    assert Pair(ros, callback).ask(6, 7).sum == result


@pytest.mark.parametrize("wrong", [None, Trigger.Response(), 5])
def test_callback_must_return_the_response(ros: Any, wrong: Any) -> None:
    pair = Pair(ros, lambda request, response: wrong)
    future = pair.client.call_async(AddTwoInts.Request())
    with pytest.raises(TypeError):
        pair.server.executor.spin_once()
    assert not future.done()


def test_exception_in_a_callback_leaves_spin(ros: Any) -> None:
    pair = Pair(ros, lambda request, response: 1 / 0)
    future = pair.client.call_async(AddTwoInts.Request())
    with pytest.raises(ZeroDivisionError):
        pair.server.executor.spin_once()
    assert not future.done()


def test_requests_are_copied(ros: Any) -> None:
    seen = []
    pair = Pair(ros, lambda request, response: (seen.append(request), response)[1])
    request = AddTwoInts.Request(a=1)
    future = pair.client.call_async(request)
    request.a = 2
    ros.spin(future.done)
    assert seen == [AddTwoInts.Request(a=1)]


@pytest.mark.parametrize("wrong", [5, None, AddTwoInts.Response(), Trigger.Request(), AddTwoInts])
def test_requests_of_other_types_are_rejected(ros: Any, wrong: Any) -> None:
    client = Pair(ros).client
    for call in (client.call, client.call_async):
        with pytest.raises(TypeError):
            call(wrong)


def test_request_without_a_server_is_lost(ros: Any) -> None:
    node = ros.node()
    client = node.create_client(AddTwoInts, "add")
    future = client.call_async(AddTwoInts.Request())
    node.create_service(AddTwoInts, "add", add)
    ros.settle()
    assert not future.done()
    client.remove_pending_request(future)
    assert client._pending_requests == {}


def test_cancelled_call_is_forgotten(ros: Any) -> None:
    pair = Pair(ros)
    future = pair.client.call_async(AddTwoInts.Request())
    future.cancel()
    ros.settle()
    assert (future.cancelled(), future.done(), pair.client._pending_requests) == (True, False, {})


def test_done_callback_gets_the_response(ros: Any) -> None:
    pair, got = Pair(ros), []
    future = pair.client.call_async(AddTwoInts.Request(a=1, b=1))
    future.add_done_callback(lambda done: got.append(done.result().sum))
    ros.spin(lambda: bool(got))
    assert got == [2]


def test_two_servers_of_one_name_both_receive_requests(ros: Any) -> None:
    calls = []
    for name in ("s1", "s2"):
        ros.node(name).create_service(
            AddTwoInts, "add", lambda request, response, name=name: (calls.append(name), response)[1]
        )
    client = ros.node("client").create_client(AddTwoInts, "add")
    future = client.call_async(AddTwoInts.Request())
    ros.spin(future.done)
    ros.settle()
    assert calls == ["s1", "s2"]


def test_readiness_requires_a_server_of_the_same_type(stepped_ros: Any) -> None:
    node = stepped_ros.node()
    client = node.create_client(AddTwoInts, "add")
    node.create_service(Trigger, "add", add)
    start = node.get_clock().now()
    assert (client.service_is_ready(), client.wait_for_service(timeout_sec=0.3)) == (False, False)
    assert (node.get_clock().now() - start).nanoseconds == 300_000_000
    threading.Timer(0.5, lambda: node.create_service(AddTwoInts, "add", add)).start()
    assert client.wait_for_service() and client.service_is_ready()


def test_waiting_for_a_service_ends_with_the_context(stepped_ros: Any) -> None:
    client = stepped_ros.node().create_client(AddTwoInts, "add")
    threading.Timer(1.0, stepped_ros.context.shutdown).start()
    with pytest.raises(RCLError, match="rcl node's context is invalid"):
        client.wait_for_service()


def test_call_blocks_until_the_response(stepped_ros: Any) -> None:
    pair = Pair(stepped_ros)
    executor = SingleThreadedExecutor(context=stepped_ros.context)
    for node in (pair.server, pair.node):
        executor.add_node(node)
    thread = threading.Thread(target=executor.spin, daemon=True)
    thread.start()
    assert pair.client.call(AddTwoInts.Request(a=4, b=5)).sum == 9
    executor.shutdown()
    thread.join()


def test_call_times_out(stepped_ros: Any) -> None:
    client = stepped_ros.node().create_client(AddTwoInts, "add")
    assert client.call(AddTwoInts.Request(), timeout_sec=0.2) is None
    assert client._pending_requests == {}


def test_call_within_a_callback_of_another_group_works(ros: Any) -> None:
    pair, got, done = Pair(ros), [], threading.Event()
    client = pair.node.create_client(AddTwoInts, "add", callback_group=MutuallyExclusiveCallbackGroup())

    def ask() -> None:
        got.append(client.call(AddTwoInts.Request(a=1, b=1), timeout_sec=TIMEOUT_S).sum)
        done.set()

    pair.node.create_guard_condition(ask).trigger()
    executor = MultiThreadedExecutor(3, context=ros.context)
    for node in (pair.server, pair.node):
        executor.add_node(node)
    thread = threading.Thread(target=executor.spin, daemon=True)
    thread.start()
    assert done.wait(TIMEOUT_S)
    executor.shutdown()
    thread.join(TIMEOUT_S)
    assert got == [2]


@pytest.mark.parametrize("own_group", [True, False])
def test_call_can_be_awaited_within_a_callback(ros: Any, own_group: bool) -> None:
    pair, got = Pair(ros), []
    group = MutuallyExclusiveCallbackGroup() if own_group else None
    client = pair.node.create_client(AddTwoInts, "add", callback_group=group)

    async def ask() -> None:
        answer = await client.call_async(AddTwoInts.Request(a=4, b=5))
        got.append(answer.sum)

    pair.node.create_guard_condition(ask).trigger()
    ros.settle()
    assert got == ([9] if own_group else []), "in one exclusive group the response waits forever"


def test_names_are_expanded_and_remapped(ros: Any) -> None:
    ros.init("-r", "do:=act")
    node = ros.node(namespace="/ns")
    service, client = node.create_service(Trigger, "do", add), node.create_client(Trigger, "~/do")
    assert (service.srv_name, service.service_name) == ("do", "/ns/act")
    assert (client.srv_name, client.service_name) == ("~/do", "/ns/n/do")


def test_destroyed_service_and_client_raise_invalid_handle(ros: Any) -> None:
    pair = Pair(ros)
    assert pair.node.destroy_client(pair.client) and not pair.node.destroy_client(pair.client)
    assert pair.server.destroy_service(pair.service) and not pair.server.destroy_service(pair.service)
    for use in (lambda: pair.client.call_async(AddTwoInts.Request()), pair.client.service_is_ready):
        with pytest.raises(InvalidHandle):
            use()


@pytest.mark.parametrize("kind", [int, "std_srvs/Trigger", AddTwoInts.Request])
def test_only_service_types_are_accepted(ros: Any, kind: Any) -> None:
    node = ros.node()
    for make in (lambda: node.create_client(kind, "x"), lambda: node.create_service(kind, "x", add)):
        with pytest.raises((RuntimeError, AttributeError, TypeError)):
            make()
