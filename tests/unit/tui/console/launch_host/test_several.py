"""The hosts of a domain as one launcher: whoever draws never waits until the own host has been started."""

from __future__ import annotations

import threading
from collections.abc import Mapping
from concurrent.futures import Future
from typing import Any, cast

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.launch_host.proxy import HostedLauncher
from bot_console.tui.console.launch_host.several import SeveralLaunchers
from bot_console.tui.console.model import LaunchInfo

PATIENCE = 30.0
"""Seconds after which a test gives up; nothing is measured by it."""


class Own:
    """A host that is started when it is told to, and what is asked of it."""

    def __init__(self) -> None:
        self.may_start, self.closed = threading.Event(), threading.Event()
        self.launched: list[str] = []
        self.problem = ""

    def started(self) -> HostedLauncher:
        assert self.may_start.wait(PATIENCE)
        if self.problem:
            raise OSError(self.problem)
        return cast(HostedLauncher, self)

    def launch(self, path: str, arguments: Mapping[str, str]) -> Future[Answer]:
        self.launched.append(path)
        answer: Future[Answer] = Future()
        answer.set_result(Answer(True, path))
        return answer

    def info(self) -> LaunchInfo:
        return LaunchInfo()

    def close(self) -> None:
        self.closed.set()


def several(own: Own) -> SeveralLaunchers:
    return SeveralLaunchers(own.started, tuple, tuple, lambda door: None)


def beside(work: Any) -> Any:
    """What a thread comes back with, which must not wait for the host."""
    found: list[Any] = []
    thread = threading.Thread(target=lambda: found.append(work()), daemon=True)
    thread.start()
    thread.join(PATIENCE)
    assert found, "it waits"
    return found[0]


def test_nobody_waits_for_a_host_that_is_being_started() -> None:
    own = Own()
    launcher = several(own)
    answer = beside(lambda: launcher.launch("one", {}))
    assert beside(launcher.info).processes == ()
    assert not answer.done()
    own.may_start.set()
    assert answer.result(PATIENCE) == Answer(True, "one")
    assert launcher.launch("two", {}).result(PATIENCE).ok and own.launched == ["one", "two"]
    launcher.close()
    assert own.closed.is_set()


def test_a_host_that_comes_after_the_end_is_ended_at_once() -> None:
    own = Own()
    launcher = several(own)
    launcher.launch("one", {})
    beside(lambda: launcher.close() or True)
    own.may_start.set()
    assert own.closed.wait(PATIENCE)


def test_a_host_that_cannot_be_started_is_an_answer() -> None:
    own = Own()
    own.problem = "no room"
    own.may_start.set()
    assert several(own).launch("one", {}).result(PATIENCE) == Answer(False, "no launch host could be started: no room")
