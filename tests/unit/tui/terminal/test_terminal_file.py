"""A terminal that goes away blocks nobody."""

from __future__ import annotations

import contextlib
import os
import pty
import select
import tty

from bot_console.tui.terminal.terminal_file import TerminalFile
from textual.drivers._writer_thread import MAX_QUEUED_WRITES, WriterThread

TIMEOUT_S = 240.0
"""Seconds after which a test gives up; nothing is measured by it."""


def test_the_writer_outlives_its_terminal() -> None:
    far, near = pty.openpty()
    with contextlib.suppress(OSError), os.fdopen(near, "w") as file:  # closing writes the rest, to nobody
        lasting = TerminalFile(file)
        writer = WriterThread(lasting)
        writer.start()
        writer.write("before")
        assert os.read(far, 6) == b"before"
        os.close(far)
        for _ in range(3 * MAX_QUEUED_WRITES):
            writer.write("after")
        writer.stop()
    assert lasting.gone


def test_written_output_reaches_the_terminal() -> None:
    far, near = pty.openpty()
    with os.fdopen(near, "w") as file:
        lasting = TerminalFile(file)
        assert lasting.write("two words") == 9
        lasting.flush()
        assert lasting.isatty() and lasting.fileno() == near
        assert os.read(far, 20) == b"two words"
    os.close(far)


def test_non_blocking_terminal_gets_all_output() -> None:
    far, near = pty.openpty()
    tty.setraw(near)
    os.set_blocking(near, False)
    text = "".join(f"{number:6d}" for number in range(50_000))
    with os.fdopen(near, "w") as file:
        lasting = TerminalFile(file)
        writer = WriterThread(lasting)
        writer.start()
        writer.write(text)
        read = b""
        while len(read) < len(text):
            assert select.select([far], [], [], TIMEOUT_S)[0], "nothing more comes"
            read += os.read(far, 65536)
        writer.stop()
    assert read == text.encode() and not lasting.gone
    os.close(far)
