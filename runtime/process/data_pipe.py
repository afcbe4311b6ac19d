"""What only this process knows about itself, as plain data through a pipe inherited from the process that started it.

One JSON object per line, `{"kind": ..., ...}`. A crash in C code writes its stacks into the same pipe as plain text.
"""

from __future__ import annotations

import faulthandler
import json
import os
from _thread import allocate_lock
from typing import Any

REMEMBERED = 1 << 20
"""Bytes that wait here at most where the parent does not read; what comes then is lost."""


class _Pipe:
    def __init__(self) -> None:
        self.descriptor = -1
        self.rest = b""
        self.guard = allocate_lock()


_pipe = _Pipe()


def use(descriptor: int) -> None:
    """Tell by this descriptor from now on, without ever waiting; stacks of a crash go there, too."""
    os.set_blocking(descriptor, False)
    _pipe.descriptor = descriptor
    faulthandler.enable(descriptor)


def is_open() -> bool:
    """Whether anybody listens."""
    return _pipe.descriptor >= 0


def tell(kind: str, **facts: Any) -> None:
    """Tell the parent; without one this does nothing. Never waits."""
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
        except OSError:  # the parent is gone
            _pipe.descriptor, _pipe.rest = -1, b""
