"""The guardian beside the console: what it is told."""

from __future__ import annotations

import os
import pty
import subprocess
from typing import Any

import pytest
from bot_console.tui.terminal import guarding

PATIENCE = 60.0
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
        with guarding.guarded(slave) as watch:
            watch.has_begun()
            [guardian] = started
            assert guardian.poll() is None
            watch.has_ended()
            assert guardian.wait(PATIENCE) == 0, "while this program still has things to do"
    finally:
        os.close(master)
        os.close(slave)
