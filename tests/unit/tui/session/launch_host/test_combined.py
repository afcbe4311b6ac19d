"""The hosts of a domain as one launcher: the drawing thread never waits while this console's own host starts."""

from __future__ import annotations

import threading
from collections.abc import Mapping
from concurrent.futures import Future
from typing import Any, cast

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.model import LaunchArgument, LaunchInfo, ProcessInfo, ProcessState
from bot_console.tui.session.launch_host import combined as combining
from bot_console.tui.session.launch_host.combined import CombinedLauncher, OtherHosts
from bot_console.tui.session.launch_host.proxy import HostedLauncher
from pytest import MonkeyPatch

TIMEOUT_S = 240.0
"""Seconds after which a test gives up; the tests measure no time."""


class Host:
    """A launch host with one process per launch, and the requests it received."""

    def __init__(self) -> None:
        self.closed = threading.Event()
        self.launched: list[str] = []
        self.is_gone = False

    def launch(self, path: str, arguments: Mapping[str, str]) -> Future[Answer]:
        self.launched.append(path)
        answer: Future[Answer] = Future()
        answer.set_result(Answer(True, path))
        return answer

    def arguments(self, path: str) -> tuple[LaunchArgument, ...]:
        return ()

    def info(self) -> LaunchInfo:
        return LaunchInfo(processes=tuple(ProcessInfo(each, each, ProcessState.RUNNING) for each in self.launched))

    def close(self) -> None:
        self.closed.set()


class OwnHost(Host):
    """A host that starts when the test lets it."""

    def __init__(self) -> None:
        super().__init__()
        self.may_start = threading.Event()
        self.problem = ""

    def started(self) -> tuple[str, HostedLauncher]:
        assert self.may_start.wait(TIMEOUT_S)
        if self.problem:
            raise OSError(self.problem)
        return "own", cast(HostedLauncher, self)


def combined(own: OwnHost) -> CombinedLauncher:
    return CombinedLauncher(own.started, tuple)


def run_in_thread(work: Any) -> Any:
    """The result of work in another thread, which must not wait for the host."""
    found: list[Any] = []
    thread = threading.Thread(target=lambda: found.append(work()), daemon=True)
    thread.start()
    thread.join(TIMEOUT_S)
    assert found, "it waits"
    return found[0]


def test_nothing_waits_for_a_host_that_is_being_started() -> None:
    own = OwnHost()
    launcher = combined(own)
    answer = run_in_thread(lambda: launcher.launch("one", {}))
    assert run_in_thread(launcher.info).processes == ()
    assert not answer.done()
    own.may_start.set()
    assert answer.result(TIMEOUT_S) == Answer(True, "one")
    assert launcher.launch("two", {}).result(TIMEOUT_S).ok and own.launched == ["one", "two"]
    launcher.close()
    assert own.closed.is_set()


def test_a_host_that_starts_after_closing_is_ended_at_once() -> None:
    own = OwnHost()
    launcher = combined(own)
    launcher.launch("one", {})
    run_in_thread(lambda: launcher.close() or True)
    own.may_start.set()
    assert own.closed.wait(TIMEOUT_S)


def test_a_host_that_cannot_be_started_is_reported_in_the_answer() -> None:
    own = OwnHost()
    own.problem = "no room"
    own.may_start.set()
    assert combined(own).launch("one", {}).result(TIMEOUT_S) == Answer(
        False, "no launch host could be started: no room"
    )


def labels(launcher: CombinedLauncher) -> list[str]:
    return [each.label for each in launcher.info().processes]


def test_own_host_found_by_its_address_before_it_is_known_is_shown_once(monkeypatch: MonkeyPatch) -> None:
    monkeypatch.setattr(combining, "HOSTS_POLL_S", 0.001)
    own, entered, searched = OwnHost(), Host(), threading.Semaphore(0)

    def addresses() -> list[str]:
        searched.release()
        return ["own"]

    launcher = CombinedLauncher(
        own.started, tuple, OtherHosts(addresses, lambda address: cast(HostedLauncher, entered))
    )
    entered.launched = own.launched  # both are connections to the same host
    answer = launcher.launch("one", {})
    assert searched.acquire(timeout=TIMEOUT_S) and searched.acquire(timeout=TIMEOUT_S)
    own.may_start.set()
    assert answer.result(TIMEOUT_S).ok
    assert entered.closed.is_set()
    assert searched.acquire(timeout=TIMEOUT_S) and searched.acquire(timeout=TIMEOUT_S)
    assert labels(launcher) == ["one"]
    launcher.close()
    assert own.closed.is_set()


def test_each_launch_file_gets_a_separate_host_if_hosts_are_not_reused() -> None:
    hosts: list[Host] = []

    def start() -> tuple[str, HostedLauncher]:
        hosts.append(Host())
        return str(len(hosts)), cast(HostedLauncher, hosts[-1])

    launcher = CombinedLauncher(start, tuple, reuse=False)
    launcher.arguments("one")
    assert all(launcher.launch(each, {}).result(TIMEOUT_S).ok for each in ("one", "two"))
    assert [each.launched for each in hosts] == [["one"], ["two"]]
    assert labels(launcher) == ["one", "two"] and len({each.key for each in launcher.info().processes}) == 2
    launcher.close()
    assert all(each.closed.is_set() for each in hosts)
    assert not launcher.launch("three", {}).result(TIMEOUT_S).ok and len(hosts) == 2


def test_a_lost_host_is_replaced_for_the_next_launch() -> None:
    hosts: list[Host] = []

    def start() -> tuple[str, HostedLauncher]:
        hosts.append(Host())
        return str(len(hosts)), cast(HostedLauncher, hosts[-1])

    launcher = CombinedLauncher(start, tuple)
    assert launcher.launch("one", {}).result(TIMEOUT_S).ok
    hosts[0].is_gone = True
    assert launcher.launch("two", {}).result(TIMEOUT_S).ok
    assert labels(launcher) == ["one", "two"]
    launcher.close()
