"""A request that can no longer be answered ends with an error that names the missing node."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest
from ros2cli import advice, direct_node
from ros2cli.direct_node import NoAnswer, answer


class Asking:
    """A node, a client and a request that is answered at the third poll, if ever."""

    def __init__(self, *, answers: bool) -> None:
        self.polls = 0
        self.gone_at: tuple[int, ...] = ()
        self.frozen: dict[int, list[str]] = {}
        self.ended = False
        bus = SimpleNamespace(stopped=lambda: self.frozen, watch_servers=lambda endpoint: lambda: self.ended)
        self.context, self.endpoint = SimpleNamespace(bus=bus), None
        self.service_name = "/robot/get"
        self._answers = answers

    def get_service_names_and_types_by_node(self, name: str, namespace: str) -> list[tuple[str, list[str]]]:
        return {("robot", "/"): [("/robot/get", [])], ("arm", "/left"): [("/left/arm/get", [])]}[name, namespace]

    def service_is_ready(self) -> bool:
        return self.polls not in self.gone_at

    def done(self) -> bool:
        self.polls += 1
        assert self.polls < 20
        return self._answers and self.polls > 2

    def result(self) -> str:
        return "answer"


@pytest.fixture(autouse=True)
def no_waiting(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(direct_node, "spin_until", lambda node, done, timeout: done())
    monkeypatch.setattr(direct_node, "GONE_POLLS", 2)


def ask(it: Any) -> Any:
    return answer(it, it, it)


def test_frozen_process_of_another_node_does_not_end_the_wait() -> None:
    it = Asking(answers=True)
    it.frozen = {7: ["/left/arm"]}
    assert ask(it) == "answer"


def test_frozen_process_is_named() -> None:
    it = Asking(answers=False)
    it.frozen = {7: ["/left/arm", "/robot"]}
    with pytest.raises(NoAnswer, match=r"^/robot does not answer: its process 7 is stopped$"):
        ask(it)


def test_node_that_ends_during_the_request_is_reported() -> None:
    it = Asking(answers=False)
    it.gone_at = (2, *range(4, 7))
    with pytest.raises(NoAnswer, match=r"^nobody answers /robot/get: its node has ended"):
        ask(it)
    assert it.polls == 6


@pytest.mark.parametrize(("is_read", "polls"), [(True, 2), (False, 14)])
def test_node_known_to_have_ended_is_reported_sooner_to_a_person(
    monkeypatch: pytest.MonkeyPatch, is_read: bool, polls: int
) -> None:
    monkeypatch.setattr(direct_node, "GONE_POLLS", 99)
    monkeypatch.setattr(direct_node, "stderr_is_terminal", lambda: is_read)
    it = Asking(answers=False)
    it.gone_at, it.ended = tuple(range(1, 20)), True
    with pytest.raises(NoAnswer, match=r"^nobody answers /robot/get: its node has ended"):
        ask(it)
    assert it.polls == polls


def test_node_still_in_the_graph_is_waited_for() -> None:
    it = Asking(answers=True)
    it.ended = True
    assert ask(it) == "answer"


def test_node_missing_in_a_single_poll_is_waited_for() -> None:
    it = Asking(answers=True)
    it.gone_at = (1,)
    assert ask(it) == "answer"


@pytest.mark.parametrize(("polls", "hints"), [(1, 1), (2, 1), (3, 0)])
def test_hint_names_once_what_is_waited_for(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], polls: int, hints: int
) -> None:
    monkeypatch.setattr(direct_node, "HINT_POLLS", polls)
    monkeypatch.setattr(advice, "is_read", lambda: True)
    assert ask(Asking(answers=True)) == "answer"
    assert capsys.readouterr().err.count("waiting for an answer of /robot/get: its node is busy") == hints
    monkeypatch.setattr(advice, "is_read", lambda: False)
    assert ask(Asking(answers=True)) == "answer"
    assert capsys.readouterr().err == ""


class Graph:
    """A graph that arrives bit by bit: one part every half second of a clock that advances only by waiting."""

    def __init__(self, *parts: str) -> None:
        self._parts = parts
        self.steps = 0

    def now(self) -> float:
        return self.steps / 2

    def wait(self, done: Any, seconds: float) -> bool:
        for _ in range(int(seconds * 2)):
            self.steps += 1
            if done():
                return True
        return False

    def get_name(self) -> str:
        return "_ros2cli"

    def _there(self, kind: str) -> list[tuple[str, Any]]:
        there = [each.split() for each in self._parts[: self.steps]]
        return [(name, "/" if kind == "node" else ["type"]) for each, name in filter(None, there) if each == kind]

    def get_node_names_and_namespaces(self) -> list[tuple[str, Any]]:
        return self._there("node")

    def get_topic_names_and_types(self) -> list[tuple[str, Any]]:
        return self._there("topic")

    def get_service_names_and_types(self) -> list[tuple[str, Any]]:
        return self._there("service")


@pytest.mark.parametrize(
    ("about", "parts", "seconds"),
    [
        ("/base", ("node base",), 2.0),
        ("/base", ("node other", "", "", "", "node base", "service /base/get"), 4.5),
        ("/scan", ("node base", "", "", "", "topic /scan"), 4.0),
        ("/go", ("node base", "", "", "", "service /go/_action/send_goal"), 4.0),
        ("/nowhere", ("node base",), 6.0),
        ("", ("node base", "", "", "", "node other"), 2.0),
        ("", tuple(f"node n{index}" for index in range(8)), 5.5),
        ("", tuple(f"node n{index}" for index in range(20)), 5.0),
        ("", (), 6.0),
    ],
)
def test_graph_of_another_rclpy_gets_time_to_be_complete_and_to_find_what_a_verb_names(
    monkeypatch: pytest.MonkeyPatch, about: str, parts: tuple[str, ...], seconds: float
) -> None:
    graph: Any = Graph(*parts)
    monkeypatch.setattr(direct_node, "spin_until", lambda node, done, timeout: node.wait(done, timeout))
    monkeypatch.setattr(direct_node, "time", SimpleNamespace(monotonic=graph.now))
    direct_node._discover(graph, None, about)
    assert graph.now() == seconds
