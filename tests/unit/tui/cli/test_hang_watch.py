"""Where the threads of a console are is written when its screen hangs, and when a signal asks for it."""

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
def kept(tmp_path: Path) -> Iterator[tuple[HangWatch, Clock, list[str], Path]]:
    clock, reported, path = Clock(), list[str](), tmp_path / FILE
    with path.open("ab") as file:
        watch = HangWatch(path, file.fileno(), reported.append, clock)
        yield watch, clock, reported, path
        watch.rest()


def test_a_signal_has_them_written_with_how_the_screen_is(tmp_path: Path) -> None:
    before = signal.getsignal(signal.SIGUSR1)
    with hang_watch(tmp_path / "new", lambda: "one screen", print):
        os.kill(os.getpid(), signal.SIGUSR1)
        text = (tmp_path / "new" / FILE).read_text()
    assert HERE in text and f"process {os.getpid()}: one screen" in text
    assert signal.getsignal(signal.SIGUSR1) == before


def test_who_does_nothing_for_long_is_found_in_the_file_once(kept: tuple[HangWatch, Clock, list[str], Path]) -> None:
    watch, clock, _, path = kept
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


def test_a_signal_that_ends_the_process_has_them_written_where_no_thread_may_run(tmp_path: Path) -> None:
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


def test_that_it_stood_is_reported_when_it_goes_on(kept: tuple[HangWatch, Clock, list[str], Path]) -> None:
    watch, clock, reported, path = kept
    watch.heartbeat()
    clock.now += HANG_AFTER_S - 1
    watch.heartbeat()
    assert reported == []
    clock.now += HANG_AFTER_S
    watch.heartbeat()
    [line] = reported
    assert "hung for 15 s" in line and str(path) in line
    assert "hung for 15 s" in path.read_text()


def test_a_rest_is_no_standstill(kept: tuple[HangWatch, Clock, list[str], Path]) -> None:
    watch, clock, reported, _ = kept
    watch.heartbeat()
    watch.rest()
    clock.now += 10 * HANG_AFTER_S
    watch.heartbeat()
    assert reported == []


def test_a_place_that_cannot_be_written_is_no_reason_to_have_no_console(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with hang_watch(tmp_path / "file", lambda: "", print) as watch:
        assert watch is None


class App:
    """An app that keeps the messages it is sent until it is told to deal with them."""

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
def test_an_app_that_stands_while_its_loop_runs_is_found_with_what_it_waits_for(
    kept: tuple[HangWatch, Clock, list[str], Path], held: bool
) -> None:
    watch, _, reported, path = kept
    app = App()

    async def waits() -> None:
        await asyncio.Event().wait()

    async def stand() -> None:
        waiting = asyncio.create_task(waits(), name="message pump App()")
        await asyncio.sleep(0)
        for _ in range(3 * MAX_MISSED_HEARTBEATS):
            watch.observe(app)
            app.deal()
        assert (path.read_text(), reported) == ("", []), "one that answers"
        app.holds_frames = held
        for _ in range(2 * MAX_MISSED_HEARTBEATS):
            watch.observe(app)
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
