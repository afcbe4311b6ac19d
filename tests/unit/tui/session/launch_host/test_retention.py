"""The last minutes are kept where the nodes run: a console asks the launch host to save them."""

from __future__ import annotations

import socket
from concurrent.futures import Future
from types import SimpleNamespace
from typing import Any

import pytest
from bot_console.tui.console.answer import Answer
from bot_console.tui.console.model import LaunchInfo
from bot_console.tui.session.launch_host.host import LaunchHost
from bot_console.tui.session.launch_host.proxy import HostedLauncher


class FakeBuffer:
    kept_s = 120.0

    def keep(self, folder: str) -> Future[Answer]:
        outcome: Future[Answer] = Future()
        outcome.set_result(Answer(True, f"in {folder}"))
        return outcome


@pytest.mark.parametrize(
    ("past", "ok", "text"), [(FakeBuffer(), True, "in /there"), (None, False, "does not know 'keep'")]
)
def test_a_host_saves_the_last_minutes_it_keeps(past: FakeBuffer | None, ok: bool, text: str) -> None:
    ours, theirs = socket.socketpair()
    service: Any = SimpleNamespace(info=LaunchInfo, close=lambda: None)
    host = LaunchHost(lambda record, printed: service, buffer=past)
    host.connect(theirs)
    launcher = HostedLauncher(ours, lambda *record: None, lambda *line: None, owner=False)
    answer = launcher.keep("/there").result(240)
    launcher.close()
    host.close()
    assert answer.ok is ok and text in answer.text
