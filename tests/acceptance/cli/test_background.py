"""A robot in the background: started, found, not doubled, and ended, from terminals of their own."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

if os.name == "nt":
    pytest.skip("programs meet on Unix sockets", allow_module_level=True)

PATIENCE = 90.0
"""Seconds after which a test gives up; nothing is measured by it."""


def typed(*words: str) -> subprocess.CompletedProcess[str]:
    line = [sys.executable, "-m", "bot_console.tui", *words]
    return subprocess.run(line, capture_output=True, text=True, timeout=PATIENCE, check=False)


@pytest.fixture
def state(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    monkeypatch.setenv("ROS_HOME", str(tmp_path))
    yield tmp_path
    typed("down")


def test_a_robot_in_the_background(state: Path) -> None:
    assert typed("status").returncode == 1
    assert typed("down").returncode == 1
    started = typed("up", "warehouse", "--seed", "1")
    assert started.returncode == 0, started.stderr
    assert "bot-console attach" in started.stdout
    told = typed("status")
    assert told.returncode == 0 and "warehouse" in told.stdout and "/simulator" in told.stdout
    again = typed("up")
    assert again.returncode == 1 and "runs already" in again.stderr
    apart = typed("--headless", "--duration", "0.5")
    assert "runs apart" in apart.stderr and apart.returncode == 0
    ended = typed("down")
    assert ended.returncode == 0 and ended.stdout.startswith("ended: ")
    assert typed("status").returncode == 1
    (log,) = (state / "bot-console" / "systems").glob("*.log")
    assert '"distance"' in log.read_text(encoding="utf-8"), "it came to rest and told its report"


def test_what_cannot_start_is_told(state: Path) -> None:
    failed = typed("up", "--launch", "nowhere.launch.py")
    assert failed.returncode == 1
    assert failed.stderr == "there is no launch file nowhere.launch.py\n"
    assert typed("status").returncode == 1
