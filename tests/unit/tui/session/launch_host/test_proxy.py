"""What a console learns from a launch host: its end, even before it has started anything, and earlier lines."""

from __future__ import annotations

import socket
import threading
import time
from types import SimpleNamespace
from typing import Any

import pytest
from bot_console.tui.console.model import LaunchInfo, Severity
from bot_console.tui.session.launch_host.host import LaunchHost
from bot_console.tui.session.launch_host.proxy import GONE, HostedLauncher

TIMEOUT_S = 240.0


def test_an_own_host_that_ends_before_it_has_started_anything_is_reported() -> None:
    ours, theirs = socket.socketpair()
    printed, reported = list[tuple[int, str, str]](), threading.Event()

    def take(severity: int, label: str, text: str) -> None:
        printed.append((severity, label, text))
        reported.set()

    launcher = HostedLauncher(ours, lambda *record: None, take)
    theirs.close()
    assert reported.wait(TIMEOUT_S)
    assert printed == [(Severity.ERROR, "launch", GONE)] and launcher.info().problem == GONE
    answer = launcher.launch("robot.launch.py", {}).result(TIMEOUT_S)
    assert not answer.ok and answer.text == GONE
    assert printed[1:] == [(Severity.ERROR, "launch", GONE)], "at a start nobody has read the first line"
    launcher.close()


def test_the_end_of_another_consoles_host_is_not_reported() -> None:
    ours, theirs = socket.socketpair()
    printed: list[object] = []
    launcher = HostedLauncher(ours, lambda *record: None, lambda *line: printed.append(line), owner=False)
    theirs.close()
    launcher._gone.wait(TIMEOUT_S)
    for thread in launcher._channel._threads:
        thread.join(TIMEOUT_S)
    assert printed == [] and launcher.info().problem == ""
    launcher.close()


def test_a_frozen_host_is_resumed_so_that_it_can_end() -> None:
    ours, theirs = socket.socketpair()
    thawed: list[bool] = []
    launcher = HostedLauncher(
        ours, lambda *record: None, lambda *line: None, hangs=lambda: "it hangs", thaw=lambda: thawed.append(True)
    )
    assert launcher.info().problem == "it hangs"
    launcher.close()
    assert thawed == [True]
    theirs.close()


def test_a_console_that_connects_later_gets_earlier_lines_with_their_own_time(monkeypatch: pytest.MonkeyPatch) -> None:
    service: Any = SimpleNamespace(info=LaunchInfo, close=lambda: None)
    host = LaunchHost(lambda record, printed: service)
    monkeypatch.setattr(time, "time_ns", lambda: 1_000)
    host.printed(Severity.INFO, "talker-1", "process started with pid [7]")
    host.noticed(Severity.WARN, "talker-1", "it waits for itself")
    monkeypatch.setattr(time, "time_ns", lambda: 2_000)
    ours, theirs = socket.socketpair()
    got, both = list[tuple[object, ...]](), threading.Event()

    def record(*line: object) -> None:
        got.append(line)
        if len(got) == 2:
            both.set()

    launcher = HostedLauncher(ours, record, lambda *line: None, owner=False)
    host.connect(theirs)
    assert both.wait(TIMEOUT_S)
    launcher.close()
    host.close()
    assert sorted(got) == [
        (1_000, Severity.INFO, "talker-1", "process started with pid [7]", ("", "", 0)),
        (1_000, Severity.WARN, "talker-1", "it waits for itself", ("", "", 0)),
    ]
