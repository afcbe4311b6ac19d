"""The output file of a terminal; once the terminal is gone, output is discarded, so that nothing waits for it."""

from __future__ import annotations

import contextlib
import os
import select
from typing import TextIO

RETRY_S = 1.0
"""Seconds after which a write to an unresponsive terminal is tried again without any event."""


class TerminalFile:
    """The file of a terminal that accepts text even after the terminal has gone or was made non-blocking.

    Textual's writer thread ends with the first error. Its queue is not emptied any more, so that every write waits
    forever, even at the end of the app. The non-blocking flag is shared by all programs that have the terminal open:
    any of them may set it, and then writing to a full terminal raises an error, although the terminal still exists.
    """

    def __init__(self, file: TextIO) -> None:
        self._file = file
        self.gone = False
        with contextlib.suppress(OSError):
            file.flush()  # writes to the descriptor bypass the file's buffer

    def write(self, text: str) -> int:
        """Write text, unless the terminal has gone; waits while the terminal is full."""
        left = memoryview(text.encode(errors="replace"))
        while left and not self.gone:
            try:
                left = left[os.write(self._file.fileno(), left) :]
            except BlockingIOError:
                self._wait()
            except (OSError, ValueError):
                # The app learns this in other ways: by the hang-up signal, or by the end of its input.
                self.gone = True
        return len(text)

    def _wait(self) -> None:
        room = select.poll()
        room.register(self._file.fileno(), select.POLLOUT)
        room.poll(RETRY_S * 1000)

    def flush(self) -> None:
        """Do nothing: writes are unbuffered."""

    def isatty(self) -> bool:
        """Whether it was a terminal when it was opened."""
        return self._file.isatty()

    def fileno(self) -> int:
        """The file descriptor."""
        return self._file.fileno()
