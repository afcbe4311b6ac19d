"""A silent browser counts as closed while a robot is steered, and only then."""

from __future__ import annotations

import os
import signal
import threading

import pytest
from bot_console.tui.cli.foreground import browser_watch as module
from bot_console.tui.cli.foreground.browser_watch import MAX_SILENCE_S, VARIABLE, BrowserWatch, browser_watch


@pytest.mark.parametrize(
    ("steers", "silence_s", "gone"), [(True, 1.01, True), (True, 0.99, False), (False, 9.0, False)]
)
def test_silence_ends_only_a_console_that_steers(steers: bool, silence_s: float, gone: bool) -> None:
    now = [10.0]
    watch = BrowserWatch(lambda: steers, lambda: now[0])
    now[0] += 5.0
    watch.hear()
    now[0] += silence_s
    assert watch.is_gone() is gone
    assert MAX_SILENCE_S == 1.0


@pytest.mark.parametrize("silence", [True, False], ids=["silent while steering", "server gone"])
def test_silent_or_closed_browser_ends_the_console_with_sighup(monkeypatch: pytest.MonkeyPatch, silence: bool) -> None:
    hung_up = threading.Event()
    monkeypatch.setattr(module, "MAX_SILENCE_S", 0.0)
    monkeypatch.setattr(
        module.os, "kill", lambda pid, number: (pid, number) == (os.getpid(), signal.SIGHUP) and hung_up.set()
    )
    reading, writing = os.pipe()
    monkeypatch.setenv(VARIABLE, str(reading))
    with browser_watch(lambda: silence):
        assert VARIABLE not in os.environ, "programs that the console starts have no browser"
        if not silence:
            os.write(writing, b".")
            assert not hung_up.is_set()
            os.close(writing)
        assert hung_up.wait(240)


def test_console_without_a_browser_is_not_watched(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(VARIABLE, raising=False)
    before = threading.active_count()
    with browser_watch(lambda: True):
        assert threading.active_count() == before
