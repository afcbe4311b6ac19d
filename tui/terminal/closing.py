"""Closing a terminal that no longer accepts output."""

from __future__ import annotations

import contextlib
import os
import signal
import termios
import threading
from collections.abc import Generator
from types import FrameType
from typing import Any, cast

LAST_WORDS = (
    "\x18\x1b[m\x1b[?2026l\x1b[?1000l\x1b[?1002l\x1b[?1003l\x1b[?1006l\x1b[?1015l\x1b[?1004l\x1b[?2004l\x1b[?7h\x1b[<u"
    "\x1b[?1049l\x1b[?25h"
)
"""Ends a truncated sequence, then resets every mode that Textual has set, in case the terminal responds again."""
FLUSH_TIMEOUT_S = 1.0
"""Seconds that a terminal may take to accept the remaining output."""


@contextlib.contextmanager
def closing_terminal(driver: Any) -> Generator[None]:
    """Wrap the closing of a driver; if its writer is still blocked after `FLUSH_TIMEOUT_S`, its output is discarded.

    Textual waits for the writer without limit, so quitting would hang on a stalled terminal.
    """
    writer: threading.Thread | None = getattr(driver, "_writer_thread", None)
    if writer is None or threading.current_thread() is not threading.main_thread():
        yield
        return
    done = threading.Event()
    watch = threading.Thread(target=_watch, args=(writer, done), name="let-go", daemon=True)
    with _interrupted_by(signal.SIGURG):
        watch.start()
        try:
            yield
        finally:
            done.set()
            watch.join()


def _watch(writer: threading.Thread, done: threading.Event) -> None:
    if done.wait(FLUSH_TIMEOUT_S) or not writer.is_alive() or writer.ident is None:
        return
    descriptor: int = cast(Any, writer)._file.fileno()  # of Textual's WriterThread
    # Kept for the last words, and to be restored: the descriptor itself is redirected to the null device.
    terminal = os.dup(descriptor)
    sink = os.open(os.devnull, os.O_WRONLY)
    # An interrupted write is retried on the same descriptor, which is the null device by then.
    os.dup2(sink, descriptor)
    while writer.is_alive() and not done.wait(0.01):
        with contextlib.suppress(ProcessLookupError):
            signal.pthread_kill(writer.ident, signal.SIGURG)
    _last_words(terminal)
    os.dup2(terminal, descriptor)
    os.close(sink)
    os.close(terminal)


def _last_words(terminal: int) -> None:
    with contextlib.suppress(OSError, termios.error):
        # The terminal's queue would be written first, but the terminal accepts nothing.
        termios.tcflush(terminal, termios.TCOFLUSH)
        os.set_blocking(terminal, False)
        try:
            os.write(terminal, LAST_WORDS.encode())
        finally:
            # The flag belongs to the terminal, not to this process: the shell would inherit it.
            os.set_blocking(terminal, True)


@contextlib.contextmanager
def _interrupted_by(number: int) -> Generator[None]:
    # An ignored signal interrupts no system call; one with a handler does.
    def nothing(number: int, frame: FrameType | None) -> None: ...

    before = signal.signal(number, nothing)
    try:
        yield
    finally:
        signal.signal(number, before)
