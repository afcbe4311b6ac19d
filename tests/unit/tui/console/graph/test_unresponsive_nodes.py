"""Nodes that are in the graph but do not respond."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest
from bot_console.tui.console.graph.unresponsive_nodes import MAX_REQUESTS_PER_POLL, UnresponsiveNodes
from bot_console.tui.console.model import Endpoint, GraphInfo, NodeInfo
from rclpy.task import Future


class Client:
    """A client as the watch sees it: whether its service is there, and the requests sent."""

    def __init__(self) -> None:
        self.ready = True
        self.asked: list[Future[Any]] = []
        self.given_up = 0

    def service_is_ready(self) -> bool:
        return self.ready

    def call_async(self, request: Any) -> Future[Any]:
        assert not request.names
        self.asked.append(Future())
        return self.asked[-1]

    def remove_pending_request(self, answer: Future[Any]) -> None:
        self.given_up += 1


class Bench:
    """A watch whose clients and timer are controlled by the test."""

    def __init__(self) -> None:
        self.clients: dict[str, Client] = {}
        self.timers: list[Any] = []
        self.silent: tuple[str, ...] = ()
        node: Any = SimpleNamespace(
            create_client=lambda kind, name: self.clients.setdefault(name.rpartition("/")[0], Client()),
            destroy_client=lambda client: self.clients.pop(next(k for k, v in self.clients.items() if v is client)),
            create_timer=lambda period, tick: self.timers.append(tick) or tick,
            destroy_timer=self.timers.remove,
        )
        self.link_delay_s = 0.0
        self.watch = UnresponsiveNodes(node, lambda silent: setattr(self, "silent", silent), lambda: self.link_delay_s)

    def tick(self, times: int = 1, *answering: str) -> None:
        """Poll `times` times; the nodes named respond at once."""
        for _ in range(times):
            self.watch.tick()
            for name in answering:
                for each in self.clients[name].asked:
                    each.done() or each.set_result(None)


def graph(*names: str) -> GraphInfo:
    return GraphInfo(tuple(NodeInfo(each, services=(Endpoint(f"{each}/get_parameter_types", ()),)) for each in names))


@pytest.fixture
def bench() -> Bench:
    made = Bench()
    made.watch.poll(True, graph("/arm", "/base"))
    return made


def test_only_a_killed_node_is_silent_after_a_second(bench: Bench) -> None:
    bench.tick(6, "/arm", "/base")
    assert bench.silent == ()
    bench.tick(2, "/base")  # its next request, at most a second later
    bench.tick(2, "/base")
    assert bench.silent == ("/arm",)
    bench.watch.follow(graph("/base"))
    assert bench.silent == () and list(bench.clients) == ["/base"]


def test_a_late_response_revives_a_node_and_a_lost_request_is_repeated(bench: Bench) -> None:
    arm = bench.clients["/arm"]
    bench.tick(4, "/base")
    assert bench.silent == ("/arm",) and len(arm.asked) == 1
    arm.asked[0].set_result(None)
    assert bench.silent == ()
    bench.tick(8, "/base")
    assert bench.silent == ("/arm",) and arm.given_up >= 1
    arm.asked[-1].set_result(None)
    assert bench.silent == ()


def test_a_response_that_takes_as_long_as_the_link_is_not_missed(bench: Bench) -> None:
    bench.link_delay_s = 4.0
    arm = bench.clients["/arm"]
    bench.tick(12, "/base")
    assert bench.silent == () and len(arm.asked) == 1 and not arm.given_up
    arm.asked[0].set_result(None)
    bench.tick(27, "/base")
    assert bench.silent == ()
    bench.tick(1, "/base")
    assert bench.silent == ("/arm",)


def test_no_node_is_asked_more_than_once_a_second(bench: Bench) -> None:
    bench.tick(20, "/arm", "/base")
    assert len(bench.clients["/arm"].asked) == 10


def test_a_new_client_waits_for_its_server_and_a_node_without_server_is_silent(bench: Bench) -> None:
    arm = bench.clients["/arm"]
    arm.ready = False
    bench.tick(6, "/base")
    assert bench.silent == () and not arm.asked
    arm.ready = True
    bench.tick(2, "/arm", "/base")
    arm.ready = False
    bench.tick(2, "/base")
    assert bench.silent == ("/arm",)


def test_nodes_are_asked_only_while_viewed_and_never_without_the_service(bench: Bench) -> None:
    bench.tick(4)
    assert bench.silent == ("/arm", "/base")
    bench.watch.poll(False, graph("/arm", "/base"))
    assert (bench.silent, bench.timers, bench.clients) == ((), [], {})
    bench.watch.poll(True, GraphInfo((NodeInfo("/cpp"),)))
    bench.tick(4)
    assert (bench.silent, bench.clients) == ((), {})


def test_many_nodes_take_turns() -> None:
    bench = Bench()
    names = [f"/n{number:03}" for number in range(2 * MAX_REQUESTS_PER_POLL)]
    bench.watch.poll(True, graph(*names))
    bench.tick(1, *names)
    assert sum(len(each.asked) for each in bench.clients.values()) == MAX_REQUESTS_PER_POLL
    bench.tick(1, *names)
    assert all(len(each.asked) == 1 for each in bench.clients.values())
