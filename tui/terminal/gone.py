"""Output to a terminal that is gone is discarded, so that nothing waits for it."""

from __future__ import annotations

import contextlib
import os
import select
from typing import TextIO

LOOK = 1.0
"""Seconds after which a terminal that takes nothing is tried again, though nothing was heard of it."""


class LastingFile:
    """The file of a terminal, which goes on taking text when the terminal has gone, or was made not to block.

    Textual's writer ends with the first error. Nobody empties its queue then, and whoever writes waits for ever, the
    end of the app included. That a terminal does not block belongs to all who have it open: any program that was
    started in the same one may set it, and a full terminal is an error then, though it is there.
    """

    def __init__(self, file: TextIO) -> None:
        self._file = file
        self.gone = False
        with contextlib.suppress(OSError):
            file.flush()  # what is written here goes past it

    def write(self, text: str) -> int:
        """Write text, if there is anybody who takes it; waits for a terminal that is full."""
        left = memoryview(text.encode(errors="replace"))
        while left and not self.gone:
            try:
                left = left[os.write(self._file.fileno(), left) :]
            except BlockingIOError:
                self._wait()
            except (OSError, ValueError):
                # The app learns of it otherwise: by the hang-up signal, or by the end of its input.
                self.gone = True
        return len(text)

    def _wait(self) -> None:
        room = select.poll()
        room.register(self._file.fileno(), select.POLLOUT)
        room.poll(LOOK * 1000)

    def flush(self) -> None:
        """Nothing is kept back."""

    def isatty(self) -> bool:
        """Whether it was a terminal."""
        return self._file.isatty()

    def fileno(self) -> int:
        """The descriptor of the file."""
        return self._file.fileno()
