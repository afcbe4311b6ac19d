"""An exception that ends the app is explained on the terminal."""

from __future__ import annotations

import io
import sys

import pytest
from bot_console.tui.terminal.exception_guard import GuardedApp
from textual.dom import DOMNode


class Failing(GuardedApp):
    """An app whose start fails."""

    def on_mount(self) -> None:
        raise ValueError("no wheels")

    def contain(self, error: Exception, culprits: list[DOMNode]) -> bool:
        return False

    def last_words(self, error: BaseException) -> str:
        return f"ended: {error}"


def test_final_message_goes_to_the_terminal_although_output_is_captured(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal, log = io.StringIO(), io.StringIO()
    monkeypatch.setattr(sys, "__stderr__", terminal)
    monkeypatch.setattr(sys, "stderr", log)
    app = Failing()
    app.run(headless=True)
    assert (terminal.getvalue(), log.getvalue(), app.return_code) == ("ended: no wheels\n", "", 1)
