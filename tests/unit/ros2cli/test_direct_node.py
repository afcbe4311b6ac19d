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
        self.looks = 0
        self.frozen: dict[int, list[str]] = {}
        self.context = SimpleNamespace(bus=SimpleNamespace(stopped=lambda: self.frozen))
        self.service_name = "/robot/get"
        self._answers = answers

    def get_service_names_and_types_by_node(self, name: str, namespace: str) -> list[tuple[str, list[str]]]:
        return {("robot", "/"): [("/robot/get", [])], ("arm", "/left"): [("/left/arm/get", [])]}[name, namespace]

    def done(self) -> bool:
        self.looks += 1
        assert self.looks < 20
        return self._answers and self.looks > 2

    def result(self) -> str:
        return "answer"


@pytest.fixture(autouse=True)
def no_waiting(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(direct_node, "spin_until", lambda node, done, timeout: done())


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
