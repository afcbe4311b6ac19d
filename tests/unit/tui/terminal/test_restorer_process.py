"""The restorer beside the console: what it is told."""

from __future__ import annotations

import os
import pty
import subprocess
from typing import Any

import pytest
from bot_console.tui.terminal import restorer_process

TIMEOUT_S = 60.0
"""Seconds after which a test gives up; nothing is measured by it."""


def test_it_goes_as_soon_as_the_terminal_is_right_again(monkeypatch: pytest.MonkeyPatch) -> None:
    started: list[subprocess.Popen[Any]] = []
    popen = subprocess.Popen

    def start(*words: Any, **how: Any) -> subprocess.Popen[Any]:
        started.append(popen(*words, **how))
        return started[-1]

    monkeypatch.setattr(subprocess, "Popen", start)
    master, slave = pty.openpty()
    try:
        with restorer_process.restored_terminal(slave) as watch:
            watch.has_begun()
            [restorer] = started
            assert restorer.poll() is None
            watch.has_ended()
            assert restorer.wait(TIMEOUT_S) == 0, "while this program still has things to do"
    finally:
        os.close(master)
        os.close(slave)
