"""A terminal that goes away does not keep anybody waiting."""

from __future__ import annotations

import contextlib
import os
import pty

from bot_console.tui.terminal.gone import LastingFile
from textual.drivers._writer_thread import MAX_QUEUED_WRITES, WriterThread


def test_the_writer_outlives_its_terminal() -> None:
    far, near = pty.openpty()
    with contextlib.suppress(OSError), os.fdopen(near, "w") as file:  # closing writes what is left, to nobody
        lasting = LastingFile(file)
        writer = WriterThread(lasting)
        writer.start()
        writer.write("before")
        assert os.read(far, 6) == b"before"
        os.close(far)
        for _ in range(3 * MAX_QUEUED_WRITES):
            writer.write("after")
        writer.stop()
    assert lasting.gone


def test_what_is_written_arrives() -> None:
    far, near = pty.openpty()
    with os.fdopen(near, "w") as file:
        lasting = LastingFile(file)
        assert lasting.write("two words") == 9
        lasting.flush()
        assert lasting.isatty() and lasting.fileno() == near
        assert os.read(far, 20) == b"two words"
    os.close(far)
