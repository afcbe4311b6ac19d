"""Writes the stacks of all threads and tasks of a console to a file if its screen hangs, or on SIGUSR1.

A hung screen cannot report anything itself, and afterwards nobody can tell what it was waiting for. The stacks are
written by a thread that holds the interpreter lock, because walking the stacks of running threads can crash the
process. So faulthandler's timer, which does not take the lock and would also expire when a stopped process continues,
is not used. If no thread gets the lock, a signal that ends the process, such as SIGABRT, makes faulthandler write them.

An app also hangs if its event loop runs, but the task that handles its messages waits for something that never comes,
or a batch of updates stays open. In that case, its tasks are written.
"""

from __future__ import annotations

import asyncio
import contextlib
import faulthandler
import os
import signal
import threading
import time
from collections.abc import Callable, Generator
from pathlib import Path
from types import FrameType
from typing import Any

from bot_console.tui.terminal.private_descriptor import private_duplicate

FILE = "console-stacks.txt"
HANG_AFTER_S = 15.0
"""Seconds without activity after which a drawing thread counts as hung."""
HEARTBEAT_S = 1.0
MAX_MISSED_HEARTBEATS = round(HANG_AFTER_S / HEARTBEAT_S)
"""Unanswered heartbeats after which an app counts as hung although its loop runs.

Counted in heartbeats, not seconds: while a process is stopped, or has lent its terminal, only the clock goes on.
"""


class HangWatch:
    """Writes the stacks of all threads unless the drawing thread reports regularly."""

    def __init__(
        self, path: Path, descriptor: int, report: Callable[[str], None], clock: Callable[[], float] = time.monotonic
    ) -> None:
        """`descriptor` is that of the file at `path`; `report` receives a line when a hung thread continues."""
        self._path = path
        self._descriptor = descriptor
        self._report = report
        self._clock = clock
        self._heard: float | None = None
        self._written = False
        self._over = threading.Event()
        self._unanswered = 0

    def watch(self) -> None:
        """Check once a second until the end, in the calling thread."""
        while not self._over.wait(HEARTBEAT_S):
            self.poll()

    def poll(self) -> None:
        """Write the stacks if the drawing thread has been silent for too long, once until it reports again."""
        heard = self._heard
        if heard is None:
            return
        if self._clock() - heard >= HANG_AFTER_S and not self._written:
            self._written = True
            faulthandler.dump_traceback(self._descriptor)

    def heartbeat(self) -> None:
        """Report that the drawing thread is running."""
        now = self._clock()
        if self._heard is not None and (stood := now - self._heard) >= HANG_AFTER_S:
            self.note(f"the screen has hung for {stood:.0f} s, or the whole process was stopped")
            self._report(f"the screen hung for {stood:.0f} s; what its threads did meanwhile is in {self._path}")
        self._heard, self._written = now, False

    def pause(self) -> None:
        """Expect no heartbeats for a while, since nothing is drawn."""
        self._heard = None

    def end(self) -> None:
        """Stop checking."""
        self._over.set()
        self.pause()

    def send_heartbeats(self) -> None:
        """Send heartbeats from the running event loop from now on."""
        self.heartbeat()
        asyncio.get_running_loop().call_later(HEARTBEAT_S, self.send_heartbeats)

    def watch_app(self, app: Any) -> None:
        """Watch a Textual app, whose event loop is the running one, from now on."""
        self.send_heartbeats()
        asyncio.get_running_loop().call_soon(self._listen, app)

        def left(_: object) -> None:  # an editor or the shell has the terminal
            self.pause()

        def back(_: object) -> None:
            self.heartbeat()

        app.app_suspend_signal.subscribe(app, left, immediate=True)
        app.app_resume_signal.subscribe(app, back, immediate=True)

    def _listen(self, app: Any) -> None:
        self.ping(app)
        asyncio.get_running_loop().call_later(HEARTBEAT_S, self._listen, app)

    def ping(self, app: Any) -> None:
        """Send the app a message, unless one is pending; write what its tasks wait for if it stays unanswered."""
        if self._unanswered == 0:
            app.call_later(self._answer, app)
        self._unanswered += 1
        if self._unanswered == MAX_MISSED_HEARTBEATS:
            self.note(
                f"the app has handled no message for {HANG_AFTER_S:.0f} s: {app.how_it_draws()}\n{waiting_tasks()}"
            )

    def _answer(self, app: Any) -> None:
        if app.holds_frames:
            app.set_timer(HEARTBEAT_S, lambda: self._answer(app))
            return
        if self._unanswered >= MAX_MISSED_HEARTBEATS:
            self.note(f"the app continues after {self._unanswered * HEARTBEAT_S:.0f} s")
            self._report(
                f"the console did nothing for {self._unanswered * HEARTBEAT_S:.0f} s; the reason is in {self._path}"
            )
        self._unanswered = 0

    def note(self, text: str) -> None:
        """Write a line to the file."""
        moment = time.strftime("%Y-%m-%d %H:%M:%S")
        with contextlib.suppress(OSError):
            os.write(self._descriptor, f"{moment}, process {os.getpid()}: {text}\n\n".encode())


@contextlib.contextmanager
def hang_watch(folder: Path, state: Callable[[], str], report: Callable[[str], None]) -> Generator[HangWatch | None]:
    """Write stacks into a file in `folder` when the screen hangs; `state` describes the screen in one line.

    `state` is called in the main thread. Yields None if the file cannot be written.
    """
    path = folder / FILE
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with path.open("ab") as file:
            descriptor = private_duplicate(file.fileno())
    except OSError:
        yield None
        return
    watching = HangWatch(path, descriptor, report)

    # Runs in the drawing thread; while that hangs, the watching thread has written the file already.
    def asked(number: int, frame: FrameType | None) -> None:
        faulthandler.dump_traceback(descriptor)
        watching.note(f"{state()}\n{waiting_tasks()}")

    before = signal.signal(signal.SIGUSR1, asked)
    fatal = not faulthandler.is_enabled()
    if fatal:
        faulthandler.enable(descriptor)
    watching.heartbeat()
    watch = threading.Thread(target=watching.watch, name="hang-watch", daemon=True)
    watch.start()
    try:
        yield watching
    finally:
        watching.end()
        watch.join()
        if fatal:
            faulthandler.disable()
        signal.signal(signal.SIGUSR1, before)
        os.close(descriptor)


def waiting_tasks() -> str:
    """The tasks of the running event loop, with the lines where they wait, outermost first.

    Tasks that wait at the same place are grouped. Empty if no loop is running in this thread.
    """
    try:
        tasks = asyncio.all_tasks()
    except RuntimeError:
        return ""
    names: dict[str, list[str]] = {}
    for each in tasks:
        names.setdefault("".join(_lines(each.get_coro())), []).append(each.get_name())
    return "\n".join(f"Task {', '.join(sorted(alike))}:\n{lines}" for lines, alike in sorted(names.items()))


def _lines(waiting: Any) -> list[str]:
    found: list[str] = []
    while waiting is not None:
        frame = getattr(waiting, "cr_frame", None) or getattr(waiting, "gi_frame", None)
        if frame is not None:
            found.append(f'  File "{frame.f_code.co_filename}", line {frame.f_lineno} in {frame.f_code.co_name}\n')
        waiting = getattr(waiting, "cr_await", None) or getattr(waiting, "gi_yieldfrom", None)
    return found
