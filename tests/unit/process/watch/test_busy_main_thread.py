"""A main thread that computes without ever waiting is reported with its line, once per occurrence."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest
from bot_console.runtime.process import unpatched
from bot_console.runtime.process.watch import busy_main_thread
from bot_console.runtime.process.watch.busy_main_thread import PERIOD_S, REPORT_S, MainWatch
from bot_console.runtime.process.watch.processor_time import wanted_seconds


class Time:
    """A clock that advances from poll to poll, with the processor time that the main thread has demanded."""

    def __init__(self, patch: pytest.MonkeyPatch) -> None:
        self.now = self.ran = 100.0
        self.waited = 0.0
        self.next: Callable[[], None] = lambda: None
        self.reported: list[str] = []
        patch.setattr(unpatched, "monotonic", lambda: self.now)
        patch.setattr(unpatched, "later", self._later)
        patch.setattr(busy_main_thread, "ran_and_waited", lambda task: (self.ran, self.waited))

    def _later(self, seconds: float, action: Callable[[], None]) -> None:
        assert seconds == PERIOD_S
        self.next = action

    def polls(self, count: int, share: float, waited: float = 0.0) -> int:
        """Poll `count` times while the thread runs, or waits for a processor, for these shares; return the number of
        reports."""
        for _ in range(count):
            self.now += PERIOD_S
            self.ran += share * PERIOD_S
            self.waited += waited * PERIOD_S
            self.next()
        return len(self.reported)


@pytest.fixture
def time(monkeypatch: pytest.MonkeyPatch) -> Time:
    return Time(monkeypatch)


POLLS = round(REPORT_S / PERIOD_S)


def test_computing_for_a_second_is_reported_once_until_a_wait(time: Time) -> None:
    MainWatch(time.reported.append).begin()
    assert time.polls(POLLS - 1, 1.0) == 0
    assert time.polls(5, 1.0) == 1
    assert time.reported[0].startswith("has computed for 1 s without waiting, in ")
    assert Path(__file__).name in time.reported[0]
    assert time.polls(1, 0.5) == 1 and time.polls(POLLS, 1.0) == 2


def test_waiting_for_a_busy_processor_is_neither_wait_nor_computing(time: Time) -> None:
    MainWatch(time.reported.append).begin()
    assert time.polls(4 * POLLS - 1, 0.25, waited=0.75) == 0
    assert time.polls(2, 0.25, waited=0.75) == 1


def test_slow_import_is_not_reported(time: Time, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(busy_main_thread.stack_frames, "is_importing", lambda ident: True)
    MainWatch(time.reported.append).begin()
    assert time.polls(10 * POLLS, 1.0) == 0


def test_thread_that_waits_now_and_then_is_not_reported(time: Time) -> None:
    MainWatch(time.reported.append).begin()
    assert time.polls(50, 0.8) == 0


def test_nothing_is_reported_without_system_statistics(time: Time, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(busy_main_thread, "ran_and_waited", lambda task: None)
    MainWatch(time.reported.append).begin()
    time.next()
    assert time.reported == []


@pytest.mark.skipif(not os.path.exists("/proc/self/schedstat"), reason="needs /proc")
def test_wanted_seconds_counts_processor_time_of_the_thread() -> None:
    before = wanted_seconds("self") or 0.0
    sum(range(300_000))
    assert (wanted_seconds("self") or 0.0) > before > 0.0
    assert wanted_seconds("0") is None
