"""The stacks of a console's threads are written when its screen hangs, and on a signal."""

from __future__ import annotations

import asyncio
import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

import pytest
from bot_console.tui.cli.foreground.hang_watch import FILE, HANG_AFTER_S, MAX_MISSED_HEARTBEATS, HangWatch, hang_watch

HERE = "in test_"


class Clock:
    now = 100.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture
def watch_rig(tmp_path: Path) -> Iterator[tuple[HangWatch, Clock, list[str], Path]]:
    clock, reported, path = Clock(), list[str](), tmp_path / FILE
    with path.open("ab") as file:
        watch = HangWatch(path, file.fileno(), reported.append, clock)
        yield watch, clock, reported, path
        watch.pause()


def test_signal_writes_stacks_and_state_of_the_screen(tmp_path: Path) -> None:
    before = signal.getsignal(signal.SIGUSR1)
    with hang_watch(tmp_path / "new", lambda: "one screen", print):
        os.kill(os.getpid(), signal.SIGUSR1)
        text = (tmp_path / "new" / FILE).read_text()
    assert HERE in text and f"process {os.getpid()}: one screen" in text
    assert signal.getsignal(signal.SIGUSR1) == before


def test_hung_thread_is_written_once(watch_rig: tuple[HangWatch, Clock, list[str], Path]) -> None:
    watch, clock, _, path = watch_rig
    watch.heartbeat()
    clock.now += HANG_AFTER_S - 1
    watch.poll()
    assert path.read_text() == ""
    for _ in range(2):
        clock.now += HANG_AFTER_S
        watch.poll()
    assert path.read_text().count("Current thread") == 1 and HERE in path.read_text()
    watch.heartbeat()
    clock.now += HANG_AFTER_S
    watch.poll()
    assert path.read_text().count("Current thread") == 2


def test_fatal_signal_writes_stacks_even_if_no_thread_can_run(tmp_path: Path) -> None:
    program = f"""
from pathlib import Path
import ctypes, os
from bot_console.tui.cli.foreground.hang_watch import hang_watch
with hang_watch(Path({str(tmp_path)!r}), str, print):
    os.write(1, b"x")
    ctypes.PyDLL(None).sleep(60)  # with the interpreter's lock
"""
    with subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE) as process:
        assert process.stdout is not None and process.stdout.read(1) == b"x"
        process.send_signal(signal.SIGUSR1)
        process.send_signal(signal.SIGABRT)
    text = (tmp_path / FILE).read_text()
    assert process.returncode == -signal.SIGABRT and "Fatal Python error" in text and 'File "<string>"' in text


def test_end_of_a_hang_is_reported(watch_rig: tuple[HangWatch, Clock, list[str], Path]) -> None:
    watch, clock, reported, path = watch_rig
    watch.heartbeat()
    clock.now += HANG_AFTER_S - 1
    watch.heartbeat()
    assert reported == []
    clock.now += HANG_AFTER_S
    watch.heartbeat()
    [line] = reported
    assert "hung for 15 s" in line and str(path) in line
    assert "hung for 15 s" in path.read_text()


def test_idle_console_is_not_a_hang(watch_rig: tuple[HangWatch, Clock, list[str], Path]) -> None:
    watch, clock, reported, _ = watch_rig
    watch.heartbeat()
    watch.pause()
    clock.now += 10 * HANG_AFTER_S
    watch.heartbeat()
    assert reported == []


def test_unwritable_folder_does_not_keep_the_console_from_starting(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with hang_watch(tmp_path / "file", lambda: "", print) as watch:
        assert watch is None


class App:
    """An app that keeps its messages until the test lets it handle them."""

    def __init__(self) -> None:
        self.messages: list[Callable[[], object]] = []
        self.holds_frames = False

    def call_later(self, callback: Callable[..., object], *words: object) -> None:
        self.messages.append(partial(callback, *words))

    def set_timer(self, seconds: float, callback: Callable[[], object]) -> None:
        self.messages.append(callback)

    def how_it_draws(self) -> str:
        return "two screens"

    def deal(self) -> None:
        messages, self.messages = self.messages, []
        for each in messages:
            each()


@pytest.mark.parametrize("held", [False, True])
def test_app_that_hangs_while_its_loop_runs_is_written_with_its_tasks(
    watch_rig: tuple[HangWatch, Clock, list[str], Path], held: bool
) -> None:
    watch, _, reported, path = watch_rig
    app = App()

    async def waits() -> None:
        await asyncio.Event().wait()

    async def stand() -> None:
        waiting = asyncio.create_task(waits(), name="message pump App()")
        await asyncio.sleep(0)
        for _ in range(3 * MAX_MISSED_HEARTBEATS):
            watch.ping(app)
            app.deal()
        assert (path.read_text(), reported) == ("", []), "one that answers"
        app.holds_frames = held
        for _ in range(2 * MAX_MISSED_HEARTBEATS):
            watch.ping(app)
            if held:
                app.deal()
        waiting.cancel()

    asyncio.run(stand())
    text = path.read_text()
    assert text.count("handled no message for 15 s: two screens") == 1, "once"
    assert text.count("message pump App():") == 1 and "in waits\n" in text and "locks.py" in text
    app.holds_frames = False
    app.deal()
    [line] = reported
    assert "did nothing for 30 s" in line and str(path) in line
