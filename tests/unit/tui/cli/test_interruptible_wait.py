"""A waiting main thread runs signal handlers, including those of signals delivered to another thread."""

from __future__ import annotations

import os
import signal
import threading
from collections.abc import Iterator

import pytest
from bot_console.tui.cli.interruptible_wait import wait_interruptibly

if os.name == "nt":
    pytest.skip("needs signals for single threads", allow_module_level=True)

TIMEOUT_S = 240.0


@pytest.fixture
def elsewhere() -> Iterator[None]:
    """Blocks SIGUSR1 in the main thread, as can happen to a process that was frozen when the signal came."""
    signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGUSR1])
    yield
    signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGUSR1])


class SignalledEvent(threading.Event):
    """An event during whose wait another thread receives a signal."""

    def wait(self, timeout: float | None = None) -> bool:
        if not hasattr(self, "_sending"):
            self._sending = threading.Thread(target=self._send)
            self._sending.start()
        return super().wait(timeout)

    def _send(self) -> None:
        signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGUSR1])
        while not self._cond._waiters:  # pyright: ignore -- whether the main thread waits already
            threading.Event().wait(0.001)
        threading.Event().wait(0.001)  # Lets it run its last steps before it sleeps.
        os.kill(os.getpid(), signal.SIGUSR1)


def test_signal_received_by_another_thread_ends_the_wait(elsewhere: None) -> None:
    over = SignalledEvent()
    before = signal.signal(signal.SIGUSR1, lambda number, frame: over.set())
    try:
        assert wait_interruptibly(over, TIMEOUT_S)
    finally:
        signal.signal(signal.SIGUSR1, before)


def test_wait_ends_at_its_timeout() -> None:
    assert not wait_interruptibly(threading.Event(), 0.0)
    assert not wait_interruptibly(threading.Event(), 0.01)
