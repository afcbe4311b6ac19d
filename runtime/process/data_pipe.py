"""Send facts that only this process knows to its parent, as plain data through an inherited pipe.

One JSON object per line, `{"kind": ..., ...}`. A crash in C code writes its stack traces into the same pipe as plain
text.
"""

from __future__ import annotations

import faulthandler
import json
import os
from _thread import allocate_lock
from typing import Any

REMEMBERED = 1 << 20
"""Maximum number of bytes buffered while the parent does not read; further data is lost."""


class _Pipe:
    def __init__(self) -> None:
        self.descriptor = -1
        self.rest = b""
        self.guard = allocate_lock()


_pipe = _Pipe()


def use(descriptor: int) -> None:
    """Use this descriptor from now on, in non-blocking mode; stack traces of crashes are written to it, too."""
    os.set_blocking(descriptor, False)
    _pipe.descriptor = descriptor
    faulthandler.enable(descriptor)


def is_open() -> bool:
    """Whether there is a parent that reads the pipe."""
    return _pipe.descriptor >= 0


def report(kind: str, **facts: Any) -> None:
    """Send a fact to the parent; does nothing without one. Never blocks."""
    if _pipe.descriptor < 0:
        return
    line = json.dumps({"kind": kind, **facts}).encode() + b"\n"
    with _pipe.guard:
        if len(_pipe.rest) + len(line) <= REMEMBERED:
            _pipe.rest += line
        try:
            _pipe.rest = _pipe.rest[os.write(_pipe.descriptor, _pipe.rest) :]
        except BlockingIOError:
            return
        except OSError:  # the parent has ended
            _pipe.descriptor, _pipe.rest = -1, b""
