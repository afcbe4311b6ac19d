"""A request that cannot be answered any more ends with the name of who does not answer."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest
from ros2cli import direct_node
from ros2cli.direct_node import NoAnswer, answer


class Asking:
    """A node, a client and a request that is answered at the third look, if at all."""

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
    monkeypatch.setattr(direct_node, "GONE", 2)


def asked(it: Any) -> Any:
    return answer(it, it, it)


def test_an_answer_is_waited_for_beside_the_frozen_process_of_another() -> None:
    it = Asking(answers=True)
    it.frozen = {7: ["/left/arm"]}
    assert asked(it) == "answer"


def test_a_frozen_process_is_named() -> None:
    it = Asking(answers=False)
    it.frozen = {7: ["/left/arm", "/robot"]}
    with pytest.raises(NoAnswer, match=r"^/robot does not answer: its process 7 is stopped$"):
        asked(it)


def test_a_node_that_ends_while_it_is_asked_is_reported() -> None:
    it = Asking(answers=False)
    it.gone_at = (2, *range(4, 7))
    with pytest.raises(NoAnswer, match=r"^nobody answers /robot/get: its node has ended"):
        asked(it)
    assert it.polls == 6


def test_a_node_that_has_ended_for_certain_is_reported_at_the_second_look(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(direct_node, "GONE", 99)
    it = Asking(answers=False)
    it.gone_at, it.ended = tuple(range(1, 20)), True
    with pytest.raises(NoAnswer, match=r"^nobody answers /robot/get: its node has ended"):
        asked(it)
    assert it.polls == 2


def test_a_node_that_is_still_there_is_waited_for_whatever_is_known() -> None:
    it = Asking(answers=True)
    it.ended = True
    assert asked(it) == "answer"


def test_an_answer_is_waited_for_where_the_node_is_not_seen_once() -> None:
    it = Asking(answers=True)
    it.gone_at = (1,)
    assert asked(it) == "answer"
