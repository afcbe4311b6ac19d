"""A console reports that its own launch host ended unrequested, even if the host had started nothing."""

from __future__ import annotations

import socket
import threading

from bot_console.tui.console.model import Severity
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
