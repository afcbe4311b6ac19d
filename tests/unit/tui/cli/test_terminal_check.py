"""Whether a screen can be drawn on this terminal."""

from __future__ import annotations

import sys

import pytest
from bot_console.tui.cli.terminal_check import NO_TERMINAL, NO_TERMINAL_TO_ATTACH, terminal_problem


@pytest.fixture
def terminal(monkeypatch: pytest.MonkeyPatch) -> pytest.MonkeyPatch:
    monkeypatch.setattr(sys.stdin, "isatty", lambda: True, raising=False)
    monkeypatch.setattr(sys.stdout, "isatty", lambda: True, raising=False)
    return monkeypatch


@pytest.mark.parametrize("term", ["xterm-256color", "linux", ""])
def test_a_terminal_that_can_move_its_cursor_has_no_problem(terminal: pytest.MonkeyPatch, term: str) -> None:
    terminal.setenv("TERM", term)
    assert not terminal_problem()


def test_a_dumb_terminal_is_refused_with_the_command_that_corrects_a_wrong_name(terminal: pytest.MonkeyPatch) -> None:
    terminal.setenv("TERM", "dumb")
    assert "export TERM=xterm-256color" in terminal_problem()


def test_a_pipe_is_no_terminal(terminal: pytest.MonkeyPatch) -> None:
    terminal.setattr(sys.stdin, "isatty", lambda: False, raising=False)
    assert terminal_problem() == NO_TERMINAL
    assert terminal_problem(NO_TERMINAL_TO_ATTACH) == NO_TERMINAL_TO_ATTACH
