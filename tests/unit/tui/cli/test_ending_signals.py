"""Signals end a console whatever locks the interrupted thread holds at that moment."""

from __future__ import annotations

import os
import signal
import sys
import threading

import pytest
from bot_console.tui.cli.foreground.ending_signals import ended_by_signals, hangup_as_signal

TIMEOUT_S = 240.0


def test_signals_do_not_deadlock_on_locks_that_ending_needs() -> None:
    lock, ended, both = threading.Lock(), list[int](), threading.Event()

    def end(number: int) -> None:
        with lock:
            ended.append(number)
        if len(ended) == 2:
            both.set()

    with ended_by_signals(end):
        with lock:
            os.kill(os.getpid(), signal.SIGTERM)
            os.kill(os.getpid(), signal.SIGHUP)
            assert not ended
        assert both.wait(TIMEOUT_S)
    assert ended == [signal.SIGTERM, signal.SIGHUP]


def test_signal_handlers_are_restored() -> None:
    before = signal.getsignal(signal.SIGTERM)
    with ended_by_signals(lambda number: None):
        assert signal.getsignal(signal.SIGTERM) != before
    assert signal.getsignal(signal.SIGTERM) == before


def test_signal_after_the_app_has_ended_is_ignored() -> None:
    def end(number: int) -> None:
        raise RuntimeError("Event loop is closed")

    with ended_by_signals(end):
        ending = next(each for each in threading.enumerate() if each.name == "ending")
        os.kill(os.getpid(), signal.SIGTERM)
        ending.join(TIMEOUT_S)
        assert not ending.is_alive()


def test_vanished_terminal_counts_as_a_signal(monkeypatch: pytest.MonkeyPatch) -> None:
    ended, ends = list[int](), threading.Event()

    def end(number: int) -> None:
        ended.append(number)
        ends.set()

    ours, its = os.openpty()
    with os.fdopen(its) as terminal:
        monkeypatch.setattr(sys, "__stdin__", terminal)
        with ended_by_signals(end), hangup_as_signal():
            assert not ends.is_set()
            os.close(ours)
            assert ends.wait(TIMEOUT_S)
    assert ended == [signal.SIGHUP]
