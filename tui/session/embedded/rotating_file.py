"""Rotating log files, so that a node with a flood of output does not fill the disk."""

from __future__ import annotations

import contextlib
import logging
import os
from logging.handlers import RotatingFileHandler
from pathlib import Path

from bot_console.runtime.files.unwritable_log import UnwritableLog

STANDARD_STREAMS = (1, 2)
LAUNCH_BYTES = 2_000_000
"""The size at which a log file of launch is rotated, in bytes."""
MAX_OLDER_FILES = 1
"""The number of older files kept."""


class RotatingFile(UnwritableLog, RotatingFileHandler):
    """Writes to a file until it has `max_bytes`; older files are named `.1` (the newest) and up.

    Descriptors in `followed` that refer to the file are redirected to the new one on rotation. Otherwise, what this
    program writes to standard output, bypassing the log, would end up in a file that is soon deleted.
    """

    def __init__(self, path: str | Path, max_bytes: int, parts: int, followed: tuple[int, ...] = ()) -> None:
        super().__init__(
            path, maxBytes=max_bytes, backupCount=parts, encoding="utf-8", delay=True, errors="backslashreplace"
        )
        self._followed = followed

    def shouldRollover(self, record: logging.LogRecord) -> bool:
        """Whether the record does not fit. The base class would query the file system for each record."""
        if self.stream is None:
            self.stream = self._open()
        return self.stream.tell() + len(self.format(record)) + 1 > self.maxBytes and self.stream.tell() > 0

    def doRollover(self) -> None:
        """Start the next file."""
        leading = [each for each in self._followed if self._is_here(each)]
        super().doRollover()
        self.stream = self.stream or self._open()
        for each in leading:
            os.dup2(self.stream.fileno(), each)

    def _is_here(self, descriptor: int) -> bool:
        with contextlib.suppress(OSError):
            return self.stream is not None and os.path.samestat(os.fstat(descriptor), os.fstat(self.stream.fileno()))
        return False


def rotate_launch_files() -> None:
    """Also rotate the files that launch keeps for each process of this run; upstream's grow without limit."""
    from launch.logging import launch_config

    def make(path: str, encoding: str | None = None) -> logging.Handler:
        return RotatingFile(path, LAUNCH_BYTES, MAX_OLDER_FILES)

    launch_config.log_handler_factory = make
