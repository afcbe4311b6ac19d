"""Answers of the terminal that arrive after the console has left it do not reach the shell."""

from __future__ import annotations

import os
import pty
import select
import tty
from collections.abc import Iterator

import pytest
from bot_console.tui.terminal import late_answers
from bot_console.tui.terminal.late_answers import STATUS, STATUS_QUESTION, read_late_answers

OWED = b"\x1b[12;1R"


class Driver:
    """Replaces Textual's driver: records the calls in order."""

    def __init__(self, descriptor: int, far: int, answer: bytes) -> None:
        self.fileno = descriptor
        self.done: list[str] = []
        self._far, self._answer = far, answer
        read_late_answers(self, lambda: True)

    def write(self, text: str) -> None:
        self.done.append(text)
        os.write(self._far, self._answer)

    def disable_input(self) -> None:
        self.done.append("disabled")

    def stop_application_mode(self) -> None:
        self.done.append("left")


@pytest.fixture
def terminal() -> Iterator[tuple[int, int]]:
    far, near = pty.openpty()
    tty.setraw(near)
    yield far, near
    os.close(far)
    os.close(near)


def test_pending_answers_are_read_before_the_terminal_is_left(terminal: tuple[int, int]) -> None:
    far, near = terminal
    driver = Driver(near, far, OWED + OWED + STATUS)
    driver.stop_application_mode()
    assert driver.done == ["disabled", STATUS_QUESTION, "left"]
    assert not select.select([near], [], [], 0)[0]


def test_terminal_without_pending_answers_is_not_queried(terminal: tuple[int, int]) -> None:
    far, near = terminal
    driver = Driver(near, far, b"")
    driver.stop_application_mode = lambda: driver.done.append("left")
    read_late_answers(driver, lambda: False)
    driver.stop_application_mode()
    assert driver.done == ["left"]


@pytest.mark.parametrize("answer", [b"", OWED])
def test_terminal_that_falls_silent_is_left(
    answer: bytes, terminal: tuple[int, int], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(late_answers, "LATE_ANSWERS_S", 0.01)
    far, near = terminal
    driver = Driver(near, far, answer)
    driver.stop_application_mode()
    assert driver.done[-1] == "left"
