"""Standard output of a node process: a text stream that passes whole lines to a sink."""

from __future__ import annotations

import codecs
import io
from _thread import RLock
from collections.abc import Callable
from typing import Any

Sink = Callable[[str], None]
"""Receives one line with its newline (which the last line may lack), in the thread that wrote it. Must never block."""


class LineCapture(io.TextIOBase):
    """A text stream like `sys.stdout` that passes lines to a sink; lines stay whole even if several threads write."""

    encoding = "utf-8"
    errors = "replace"
    line_buffering = True
    mode = "w"

    def __init__(self, sink: Sink, name: str = "<stdout>") -> None:
        self.name = name
        self.buffer = _ByteStream(self)
        self._sink = sink
        self._partial = ""
        self._lock = RLock()

    def writable(self) -> bool:
        """Return True."""
        return True

    def isatty(self) -> bool:
        """Return False: no terminal is attached."""
        return False

    def write(self, text: str) -> int:
        """Write text; each completed line goes to the sink. Raises `TypeError` for anything but text."""
        if not isinstance(text, str):  # pyright: ignore[reportUnnecessaryIsInstance] -- node code is not checked
            raise TypeError(f"write() argument must be str, not {type(text).__name__}")
        with self._lock:
            if not self.closed:
                *lines, self._partial = (self._partial + text).split("\n")
                for line in lines:
                    self._sink(line + "\n")
        return len(text)

    def reconfigure(self, **_options: Any) -> None:
        """Accept and ignore options: lines are always passed on at once, as UTF-8."""

    def end(self) -> None:
        """When the process has ended, pass on an unfinished last line and close."""
        with self._lock:
            if self._partial and not self.closed:
                self._sink(self._partial)
            self._partial = ""
            super().close()

    def mute(self) -> None:
        """Close without passing anything on: a killed process prints nothing more."""
        with self._lock:
            self._partial = ""
        self.end()

    def flush(self) -> None:
        """Do nothing: whole lines are passed on at once."""

    def close(self) -> None:
        """Stay open: `sys.stdout.close()` by a node, or the garbage collector, must not lose later output."""


class _NoInput(io.TextIOBase):
    """Standard input of a node process: always at its end, because the keyboard belongs to the console."""

    name = "<stdin>"
    encoding = "utf-8"
    errors = "strict"

    def readable(self) -> bool:
        return True

    def read(self, _size: int | None = -1) -> str:
        return ""

    def readline(self, _size: int = -1) -> str:  # type: ignore[override] -- narrower than the base, which nobody minds here
        return ""


NO_INPUT = _NoInput()


class _ByteStream(io.BufferedIOBase):
    """`sys.stdout.buffer`: accepts bytes and passes them on as text."""

    def __init__(self, text: LineCapture) -> None:
        self._text = text
        self._decode = codecs.getincrementaldecoder("utf-8")(errors="replace").decode

    def writable(self) -> bool:
        return True

    def write(self, data: Any) -> int:
        count = memoryview(data).nbytes
        self._text.write(self._decode(bytes(data)))
        return count
