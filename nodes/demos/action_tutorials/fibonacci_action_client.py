"""Nodes `fibonacci_action_client`: request ten numbers of the sequence, and exit with the result."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import rclpy
from action_tutorials_interfaces.action import Fibonacci
from bot_console_demos.running import initialised
from rclpy.action import ActionClient
from rclpy.node import Node

SEQUENCE_ORDER = 10


@dataclass(frozen=True)
class Words:
    """The log texts of a tutorial's client; numbers follow `next` and `result`."""

    accepted: str
    rejected: str
    next: str
    result: str
    sending: str = ""
    spaced: bool = False
    """Whether numbers are separated by blanks instead of printed as a list."""


PYTHON = Words("Goal accepted :)", "Goal rejected :(", "Received feedback: ", "Result: ")
CPP = Words(
    "Goal accepted by server, waiting for result",
    "Goal was rejected by server",
    "Next number in sequence received: ",
    "Result received: ",
    "Sending goal",
    spaced=True,
)


class Client(Node):
    """Sends the goal; `done` becomes true on a result or a rejection."""

    def __init__(self, words: Words) -> None:
        super().__init__("fibonacci_action_client")
        self._words = words
        self._client = ActionClient(self, Fibonacci, "fibonacci")
        self.done = False

    def send(self) -> None:
        """Wait for the server and send the goal."""
        self._client.wait_for_server()
        if self._words.sending:
            self.get_logger().info(self._words.sending)
        goal = self._client.send_goal_async(Fibonacci.Goal(order=SEQUENCE_ORDER), feedback_callback=self._on_feedback)
        goal.add_done_callback(self._on_answer)

    def _report(self, text: str, numbers: Any) -> None:
        listed = " ".join(map(str, numbers)) + " " if self._words.spaced else str(numbers)
        self.get_logger().info(text + listed)

    def _on_answer(self, answer: Any) -> None:
        goal = answer.result()
        self.get_logger().info(self._words.accepted if goal.accepted else self._words.rejected)
        self.done = not goal.accepted
        if goal.accepted:
            goal.get_result_async().add_done_callback(self._on_result)

    def _on_feedback(self, message: Any) -> None:
        self._report(self._words.next, message.feedback.partial_sequence)

    def _on_result(self, answer: Any) -> None:
        self._report(self._words.result, answer.result().result.sequence)
        self.done = True


def _run(words: Words, args: list[str] | None) -> None:
    with initialised(args):
        client = Client(words)
        client.send()
        while not client.done:
            rclpy.spin_once(client)


def main_py(args: list[str] | None = None) -> None:
    """Entry point of `action_tutorials_py`."""
    _run(PYTHON, args)


def main_cpp(args: list[str] | None = None) -> None:
    """Entry point of `action_tutorials_cpp`."""
    _run(CPP, args)
