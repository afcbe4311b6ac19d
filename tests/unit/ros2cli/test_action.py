"""`ros2 action send_goal` ends if the server that it waits for has ended, and raises a Ctrl-C between callbacks."""

from __future__ import annotations

import signal
from types import SimpleNamespace
from typing import Any

import pytest
from ros2cli import direct_node
from ros2cli.direct_node import NoAnswer
from ros2cli.verbs import action


class Server:
    """A client's view of an action server that is missing in some polls and answers in one of them, if ever."""

    def __init__(self, gone_at: range, answers_at: int) -> None:
        self._action_name = "/fibonacci"
        self._endpoints = SimpleNamespace(goal=SimpleNamespace(has_ended=False))
        self._gone_at = gone_at
        self._answers_at = answers_at
        self.polls = 0

    def server_is_ready(self) -> bool:
        return self.polls not in self._gone_at

    def polled(self, node: Any, done: Any, seconds: float) -> bool:
        self.polls += 1
        return self.polls == self._answers_at


NODE: Any = SimpleNamespace(
    context=SimpleNamespace(bus=SimpleNamespace(watch_servers=lambda goal: lambda: goal.has_ended))
)
FUTURE = SimpleNamespace(done=None, result=lambda: "result")


@pytest.fixture
def outcome(monkeypatch: pytest.MonkeyPatch) -> Any:
    monkeypatch.setattr(direct_node, "GONE_POLLS", 2)

    def waited(server: Server) -> Any:
        monkeypatch.setattr(action, "spin_until", server.polled)
        return action._outcome(NODE, server, FUTURE, action._Interrupt())  # type: ignore[arg-type]

    return waited


def test_ended_server_is_reported(outcome: Any) -> None:
    with pytest.raises(NoAnswer, match=r"^nobody answers /fibonacci: its server has ended since it was asked"):
        outcome(Server(range(3, 99), 99))


def test_returning_server_is_waited_for(outcome: Any) -> None:
    assert outcome(Server(range(3, 5), 40)) == "result"


def test_server_known_to_have_ended_is_reported_at_the_second_poll(monkeypatch: pytest.MonkeyPatch) -> None:
    server = Server(range(3, 99), 99)
    server._endpoints.goal.has_ended = True
    monkeypatch.setattr(action, "spin_until", server.polled)
    monkeypatch.setattr(direct_node, "polls_until_ended", lambda: 2)
    with pytest.raises(NoAnswer, match="has ended since it was asked"):
        action._outcome(NODE, server, FUTURE, action._Interrupt())  # type: ignore[arg-type]
    assert server.polls == 4


def test_ctrl_c_is_raised_by_the_next_check() -> None:
    before = signal.getsignal(signal.SIGINT)
    with action._Interrupt() as interrupt:
        interrupt.check()
        signal.raise_signal(signal.SIGINT)
        with pytest.raises(KeyboardInterrupt):
            interrupt.check()
        interrupt.check()
    assert signal.getsignal(signal.SIGINT) is before


def test_second_ctrl_c_is_raised_at_once() -> None:
    with action._Interrupt():
        signal.raise_signal(signal.SIGINT)
        with pytest.raises(KeyboardInterrupt):
            signal.raise_signal(signal.SIGINT)


def test_ctrl_c_while_a_server_answers_keeps_the_answer(monkeypatch: pytest.MonkeyPatch) -> None:
    """The signal arrives in the callback that receives the answer: the wait ends with it, and the answer is kept."""
    answers: list[str] = []

    def spin(node: Any, done: Any, seconds: float) -> bool:
        signal.raise_signal(signal.SIGINT)
        answers.append("taken")
        return bool(done())

    monkeypatch.setattr(action, "spin_until", spin)
    future: Any = SimpleNamespace(done=lambda: bool(answers), result=answers.copy)
    with action._Interrupt() as interrupt, pytest.raises(KeyboardInterrupt):
        action._outcome(NODE, Server(range(0), 1), future, interrupt)  # type: ignore[arg-type]
    assert answers == ["taken"]
