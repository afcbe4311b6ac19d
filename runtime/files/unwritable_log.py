"""Log files that cannot be written, for example on a full disk: reported once, without stopping anything else."""

from __future__ import annotations

import logging
import os
import sys

from bot_console.runtime.process import current
from bot_console.runtime.process.notices import notify

_reported: set[str] = set()


class UnwritableLog(logging.Handler):
    """Mixin for a handler of a log file.

    The standard library would print a traceback for each record. If the standard error stream is logged to the same
    file, that would never stop.
    """

    def handleError(self, record: logging.LogRecord) -> None:
        """Give one notice per folder and reason; other errors are handled as usual."""
        error = sys.exc_info()[1]
        if not isinstance(error, OSError):
            super().handleError(record)
            return
        folder = os.path.dirname(str(getattr(self, "baseFilename", "")))
        text = f"log files are not complete: {folder} cannot be written ({error.strerror})"
        if text not in _reported:
            _reported.add(text)
            notify(current(), text)


class LogFile(UnwritableLog, logging.FileHandler):
    """The standard library's log file handler with this error handling, also for errors on opening the file."""

    def emit(self, record: logging.LogRecord) -> None:
        """Write a record."""
        try:
            super().emit(record)
        except OSError:
            self.handleError(record)
