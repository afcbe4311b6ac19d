"""A saved log that is used like the live one: filtered, searched, and followed while it grows or is rotated."""

from __future__ import annotations

import os
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

from bot_console.tui.console.logs.port import LogView
from bot_console.tui.console.logs.saved import SavedLines
from bot_console.tui.console.logs.store import LogStore
from bot_console.tui.console.logs.view import LogViews
from bot_console.tui.console.model import LogFilter, LogRecord, LogState
from bot_console.tui.files.save_file import NotSaved, typed_path

FILE_POLL_S = 0.25
"""Seconds between two checks whether the file has grown."""
CHUNK_BYTES = 1 << 18
"""Bytes read at a time; between reads, other threads get the processor."""


class LogFile:
    """The records of a log file; implements `tui.console.logs.port.LogSource`."""

    def __init__(self, path: Path) -> None:
        """Open the file; raises `OSError` if it cannot be read."""
        self.name = str(path)
        self._store = LogStore()
        self._views = LogViews(self._store)
        self._lines = SavedLines(self._store.add, path.stem)
        self._tail = Tail(path)
        self._closed = threading.Event()
        threading.Thread(target=self._read, name="log file", daemon=True).start()

    def _read(self) -> None:
        while not self._closed.is_set():
            if not self.take_in():
                self._closed.wait(FILE_POLL_S)
        self._tail.close()

    def take_in(self) -> bool:
        """Read what has been appended; returns whether there was anything."""
        any_more = False
        for text in self._tail.more():
            any_more = True
            self._lines.feed(text)
            if self._closed.is_set():
                break
        self._lines.settle()
        return any_more

    @property
    def state(self) -> LogState:
        """Which records are kept."""
        return self._store.state

    def record(self, seq: int) -> LogRecord | None:
        """The record with that number; None if it is not kept."""
        return self._store.record(seq)

    def view(self, which: LogFilter, instead_of: LogView | None = None) -> LogView:
        """Start a search that follows new records."""
        return self._views.open(which, instead_of)

    def clear(self) -> None:
        """Discard all records; the file stays as it is."""
        self._store.clear()

    def close(self) -> None:
        """Stop reading."""
        self._closed.set()
        self._views.close()


class Tail:
    """Reads a file and what is appended to it, even after a rotation has given its name to another file."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._file: BinaryIO | None = path.open("rb")
        self._rest = b""

    def more(self) -> Iterator[str]:
        """The whole lines that have not been read yet, in pieces."""
        yield from self._whole_lines()
        if self._file is None or self._was_replaced(self._file):
            yield from self._whole_lines()  # what was appended between the last read and the rotation
            if self._rest:
                rest, self._rest = self._rest, b""
                yield rest.decode("utf-8", "replace") + "\n"
            if self._open_again():
                yield from self._whole_lines()

    def _whole_lines(self) -> Iterator[str]:
        while self._file is not None and (data := self._file.read(CHUNK_BYTES)):
            lines, end, self._rest = (self._rest + data).rpartition(b"\n")
            if end:
                yield (lines + end).decode("utf-8", "replace")

    def _was_replaced(self, file: BinaryIO) -> bool:
        """Whether the name now refers to another file, or the file was truncated."""
        try:
            there = os.stat(self._path)
        except OSError:
            return False  # the rotation is not finished yet
        here = os.fstat(file.fileno())
        if (there.st_dev, there.st_ino) != (here.st_dev, here.st_ino):
            return True
        if here.st_size < file.tell():
            file.seek(0)
            self._rest = b""
        return False

    def _open_again(self) -> bool:
        self.close()
        try:
            self._file = self._path.open("rb")
        except OSError:
            return False
        return True

    def close(self) -> None:
        """Close the file."""
        if self._file is not None:
            self._file.close()
            self._file = None


def open_log(text: str) -> LogFile:
    """Open the log file that a user names; raises `ValueError` with the reason if that fails."""
    try:
        path = typed_path(text)
    except NotSaved as error:
        raise ValueError(str(error)) from None
    try:
        if path.is_dir():
            raise ValueError(f"{path} is a folder; name a file in it")
        if path.exists() and not path.is_file():
            raise ValueError(f"{path} is not a regular file")
        return LogFile(path)
    except OSError as error:
        raise ValueError(f"{path}: {(error.strerror or str(error)).lower()}") from None
