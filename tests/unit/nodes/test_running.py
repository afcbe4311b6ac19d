"""The life of a node of the package when signals arrive more than once."""

from __future__ import annotations

import signal
from collections.abc import Iterator

import pytest
import rclpy
from bot_console_robot.common.running import CannotStart, run
from domains import unused_domain
from rclpy._rclpy_pybind11 import RCLError
from rclpy.node import Node


@pytest.fixture(autouse=True)
def domain(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    monkeypatch.setenv("ROS_DOMAIN_ID", str(unused_domain()))
    before = signal.getsignal(signal.SIGINT)
    yield
    signal.signal(signal.SIGINT, before)


class InterruptedTwice(Node):
    """Receives Ctrl-C once while it runs, and again while it ends."""

    ended = 0

    def __init__(self) -> None:
        super().__init__("impatient")
        self.create_timer(0.001, self._interrupt)

    def _interrupt(self) -> None:
        signal.raise_signal(signal.SIGINT)

    def destroy_node(self) -> None:
        signal.raise_signal(signal.SIGINT)
        InterruptedTwice.ended += 1
        super().destroy_node()


def test_second_interrupt_does_not_break_the_end() -> None:
    InterruptedTwice.ended = 0
    run(InterruptedTwice, [])
    assert InterruptedTwice.ended == 1
    assert not rclpy.ok()
    signal.raise_signal(signal.SIGINT)  # Until the interpreter has gone.


def test_interrupt_during_construction_is_a_clean_end() -> None:
    def make() -> Node:
        signal.raise_signal(signal.SIGINT)
        raise AssertionError

    run(make, [])
    assert not rclpy.ok()


def test_interrupt_during_error_handling_is_a_clean_end(monkeypatch: pytest.MonkeyPatch) -> None:
    asked = rclpy.ok

    def ok() -> bool:
        signal.raise_signal(signal.SIGINT)
        return asked()

    def make() -> Node:
        monkeypatch.setattr(rclpy, "ok", ok)
        raise RCLError("the context is gone")

    run(make, [])
    monkeypatch.undo()
    assert not rclpy.ok()


def test_next_run_can_be_interrupted_again() -> None:
    for _ in range(2):
        run(InterruptedTwice, [])


def test_node_that_cannot_start_reports_why(capfd: pytest.CaptureFixture[str]) -> None:
    def make() -> Node:
        raise CannotStart("no world")

    with pytest.raises(SystemExit) as left:
        run(make, [])
    assert left.value.code == 1
    assert "no world" in capfd.readouterr().err


def test_error_before_there_is_a_context_is_raised(monkeypatch: pytest.MonkeyPatch) -> None:
    def init(*, args: list[str] | None) -> None:
        raise MemoryError

    monkeypatch.setattr(rclpy, "init", init)
    with pytest.raises(MemoryError):
        run(InterruptedTwice, [])
