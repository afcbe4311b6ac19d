"""An operating system process as a child of a launch."""

from __future__ import annotations

import asyncio
import os
import signal
import sys
from contextlib import suppress

import pytest
from launch.child.os_child import start_os_child

WAITS = "import signal, sys; print('up', flush=True); signal.pause()"
MAX_SIGNALS = 10_000


def test_exit_code_survives_signals_sent_while_the_process_ends() -> None:
    async def play() -> int:
        up = asyncio.Event()
        child = await start_os_child(
            [sys.executable, "-c", WAITS],
            shell=False, emulate_tty=False, env=dict(os.environ), cwd=None, output=lambda fd, data: up.set(),
        )  # fmt: skip
        await up.wait()
        with suppress(ProcessLookupError):  # the process is gone before the event loop knows of it
            for _ in range(MAX_SIGNALS):
                child.send_signal(signal.SIGKILL)
        try:
            return await child.exited
        finally:
            child.close()

    assert asyncio.run(play()) == -signal.SIGKILL


def test_no_signal_is_sent_to_a_pid_whose_process_has_ended(monkeypatch: pytest.MonkeyPatch) -> None:
    sent: list[object] = []

    async def play() -> None:
        child = await start_os_child(
            [sys.executable, "-c", ""],
            shell=False, emulate_tty=False, env=dict(os.environ), cwd=None, output=lambda fd, data: None,
        )  # fmt: skip
        await child.exited
        monkeypatch.setattr(os, "kill", lambda *what: sent.append(what))
        with pytest.raises(ProcessLookupError):
            child.send_signal(signal.SIGTERM)
        child.close()

    asyncio.run(play())
    assert not sent
