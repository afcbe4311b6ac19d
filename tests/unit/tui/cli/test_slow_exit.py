"""A console that takes long to end says why; one that ends quickly says nothing."""

from __future__ import annotations

import io
import sys
import threading

import pytest
from bot_console.tui.cli.slow_exit import WAITING_TEXT, report_slow_exit


class Terminal(io.StringIO):
    """Keeps the output, and signals when the line is there."""

    def __init__(self) -> None:
        super().__init__()
        self.has_line = threading.Event()

    def isatty(self) -> bool:
        return True

    def flush(self) -> None:
        self.has_line.set()


@pytest.fixture
def terminal(monkeypatch: pytest.MonkeyPatch) -> Terminal:
    screen = Terminal()
    monkeypatch.setattr(sys, "__stderr__", screen)
    return screen


def test_slow_end_reports_what_it_waits_for(terminal: Terminal) -> None:
    with report_slow_exit(0.0):
        assert terminal.has_line.wait(240.0)
    assert terminal.getvalue() == WAITING_TEXT + "\n"


def test_quick_end_prints_nothing(terminal: Terminal) -> None:
    with report_slow_exit(600.0):
        (timer,) = (each for each in threading.enumerate() if isinstance(each, threading.Timer))
    timer.join(240.0)
    assert (timer.is_alive(), terminal.getvalue()) == (False, "")
