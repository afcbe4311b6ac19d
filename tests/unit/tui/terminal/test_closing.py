"""A terminal that accepts nothing any more does not keep the program from ending."""

from __future__ import annotations

import os
import pty
import signal
import threading
from collections.abc import Iterator
from types import SimpleNamespace
from typing import TextIO

import pytest
from bot_console.tui.terminal import closing
from textual.drivers._writer_thread import WriterThread

MORE_THAN_FITS = "x" * 1_000_000


@pytest.fixture
def terminal() -> Iterator[tuple[int, TextIO]]:
    """The far end of a terminal, and the file through which a program writes to it."""
    far, near = pty.openpty()
    with os.fdopen(near, "w") as file:
        yield far, file
    os.close(far)


def write(terminal: TextIO, text: str) -> SimpleNamespace:
    writer = WriterThread(terminal)
    writer.start()
    writer.write(text)
    return SimpleNamespace(_writer_thread=writer)


def test_stalled_terminal_does_not_block_closing(terminal: tuple[int, TextIO], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(closing, "FLUSH_TIMEOUT_S", 0.05)
    far, file = terminal
    before = signal.getsignal(signal.SIGURG)
    driver = write(file, MORE_THAN_FITS)
    with closing.closing_terminal(driver):
        driver._writer_thread.stop()
    assert not driver._writer_thread.is_alive()
    assert signal.getsignal(signal.SIGURG) == before
    assert os.isatty(file.fileno()), "the descriptor leads to the terminal again"
    os.set_blocking(far, False)
    taken = b""
    while len(taken) < 100_000 and b"\x1b[?25h" not in taken:
        taken += os.read(far, 65536)
    assert taken.endswith(closing.LAST_WORDS.encode()), "the modes are restored for when it continues"


def test_responsive_terminal_gets_all_output(terminal: tuple[int, TextIO]) -> None:
    far, file = terminal
    taken = bytearray()

    def read() -> None:
        while len(taken) < len(MORE_THAN_FITS):
            taken.extend(os.read(far, 65536))

    reader = threading.Thread(target=read)
    reader.start()
    driver = write(file, MORE_THAN_FITS)
    with closing.closing_terminal(driver):
        driver._writer_thread.stop()
    reader.join()
    assert bytes(taken) == MORE_THAN_FITS.encode()


def test_driver_without_a_writer_is_closed() -> None:
    with closing.closing_terminal(SimpleNamespace()):
        pass
