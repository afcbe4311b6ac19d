"""A terminal that has gone: what is still written is thrown away, so that nothing waits for it."""

from __future__ import annotations

from typing import TextIO


class LastingFile:
    """The file of a terminal, which goes on taking text when the terminal has gone.

    Textual's writer ends with the first error. Nobody empties its queue then, and whoever writes waits for ever, the
    end of the app included.
    """

    def __init__(self, file: TextIO) -> None:
        self._file = file
        self.gone = False

    def write(self, text: str) -> int:
        """Write text, if there is anybody who takes it."""
        if not self.gone:
            try:
                return self._file.write(text)
            except OSError:
                # The app learns of it otherwise: by the hang-up signal, or by the end of its input.
                self.gone = True
        return len(text)

    def flush(self) -> None:
        """Send what was written."""
        if not self.gone:
            try:
                self._file.flush()
            except OSError:
                self.gone = True

    def isatty(self) -> bool:
        """Whether it was a terminal."""
        return self._file.isatty()

    def fileno(self) -> int:
        """The descriptor of the file."""
        return self._file.fileno()
