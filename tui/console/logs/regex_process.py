"""Python's own regular expressions, in a separate process with a time limit.

They backtrack, some patterns endlessly, and hold the interpreter lock meanwhile: in this process they would freeze
everything. The process is started with the first pattern, serves all of them, and is killed when one takes too long.
"""

from __future__ import annotations

import atexit
import contextlib
import os
import select
import struct
import subprocess
import sys
import threading
import time
from collections.abc import Sequence
from pathlib import Path

from bot_console.tui.console.logs import regex_server

LIMIT = 0.5
"""Seconds that one pattern may take for one request: a text, or the 16,384 texts of one segment of the log."""
STARTING = 20.0
"""Seconds that the process may take to start, on a busy machine."""
KNOWN = 20_000
"""Single texts whose results are cached, since lists ask for the same ones again and again."""


class TooCostlyError(ValueError):
    """A pattern took longer than allowed."""


class RegexProcess:
    """The process; methods may be called from any thread."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._process: subprocess.Popen[bytes] | None = None

    def ask(self, pattern: bytes, blob: bytes, ends: Sequence[int]) -> bytes:
        """One byte per text, 1 if the pattern matches; raises `ValueError` with the message of `re`, or another
        reason.
        """
        with self._lock:
            process = self._running()
            try:
                self._send(process, regex_server.request(pattern, blob, ends))
                answer = self._receive(process, time.monotonic() + LIMIT)
            except OSError:
                self._kill()
                raise TooCostlyError("the process that searches has ended") from None
            except TooCostlyError:
                self._kill()
                raise
        if answer[:1] != regex_server.GOOD:
            raise ValueError(answer[1:].decode("utf-8", "replace"))
        return answer[1:]

    def _running(self) -> subprocess.Popen[bytes]:
        if self._process is None or self._process.poll() is not None:
            # A separate session, so that no signal of the terminal reaches it; it ends when the pipe is closed.
            self._process = subprocess.Popen(
                [sys.executable, "-I", "-S", str(Path(regex_server.__file__))], start_new_session=True,
                stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
            )  # fmt: skip
            atexit.register(self.close)
            self._receive(self._process, time.monotonic() + STARTING)
        return self._process

    def _send(self, process: subprocess.Popen[bytes], data: bytes) -> None:
        assert process.stdin is not None
        process.stdin.write(data)
        process.stdin.flush()

    def _receive(self, process: subprocess.Popen[bytes], deadline: float) -> bytes:
        head = self._read(process, 4, deadline)
        return self._read(process, struct.unpack("<I", head)[0], deadline)

    @staticmethod
    def _read(process: subprocess.Popen[bytes], size: int, deadline: float) -> bytes:
        assert process.stdout is not None
        handle, parts = process.stdout.fileno(), b""
        while len(parts) < size:
            if not select.select([handle], [], [], max(0.0, deadline - time.monotonic()))[0]:
                raise TooCostlyError("it took too long")
            part = os.read(handle, size - len(parts))
            if not part:
                raise OSError("the process has ended")
            parts += part
        return parts

    def _kill(self) -> None:
        process, self._process = self._process, None
        if process is not None:
            process.kill()
            for each in (process.stdin, process.stdout):
                if each is not None:
                    with contextlib.suppress(OSError):
                        each.close()
            process.wait()

    def close(self) -> None:
        """End the process."""
        with self._lock:
            self._kill()


PROCESS = RegexProcess()
_costly: dict[str, str] = {}
"""Patterns that took too long, with the error message: they are refused at once the second time."""


class ProcessEngine:
    """One pattern, searched by that process; raises `ValueError` with a readable message."""

    def __init__(self, written: str) -> None:
        self._written = written
        self._pattern = f"(?im){written}".encode("utf-8", "replace")
        self._known: dict[bytes, bool] = {}
        if written in _costly:
            raise ValueError(_costly[written])
        self._ask(b"", [])

    def _ask(self, blob: bytes, ends: Sequence[int]) -> bytes:
        try:
            return PROCESS.ask(self._pattern, blob, ends)
        except TooCostlyError as error:
            text = f"regular expression '{self._written}': too costly without google-re2, {error}"
            _costly[self._written] = text
            raise ValueError(text) from None
        except ValueError as error:
            raise ValueError(f"regular expression '{self._written}': {error}") from None

    def search(self, text: bytes) -> bool:
        """Whether it matches anywhere in a text; once a pattern has taken too long, it never matches again."""
        if text not in self._known and self._written not in _costly:
            with contextlib.suppress(ValueError):
                if len(self._known) >= KNOWN:
                    self._known.clear()
                self._known[text] = self._ask(text + b"\n", [len(text) + 1]) == b"\1"
        return self._known.get(text, False)

    def found(self, blob: bytes, ends: Sequence[int]) -> bytes:
        """One byte per text, 1 if it matches; raises `ValueError` if that takes too long."""
        if self._written in _costly:
            raise ValueError(_costly[self._written])
        return self._ask(blob, ends)
