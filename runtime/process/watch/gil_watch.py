"""Detect that C code holds the GIL: then no other thread of this process runs, not even the runtime's.

One thread of the interpreter (`faulthandler`) needs no GIL: when a heartbeat of this module is missing, that thread
writes the stacks of all threads into an in-memory file. The next heartbeat reads the file; until then, other processes
can (`gil_holder`).
"""

from __future__ import annotations

import _thread
import faulthandler
import os
import threading
from collections.abc import Callable
from typing import Any

from .. import unpatched
from .gil_holder import NAME, holding_thread, voluntary_switches

PERIOD_S = 0.5
"""Wall time (s) between two heartbeats."""
WRITTEN_S = 1.25
"""Wall time (s) after a heartbeat at which the stacks are written if no other has come: the GIL is held for 1 s."""
FIRST_HEARTBEAT_TIMEOUT_S = 1.0
"""Maximum wall time (s) that `begin` waits for the first heartbeat: a GIL held before it is never detected."""
MIN_DESCRIPTOR = 1000
"""Lowest descriptor number for the file, if allowed, out of reach of programs that close all they know of."""
TEXT = (
    "has held the interpreter's lock for 1 s, in {}. No other thread of its process runs meanwhile: do it in smaller "
    "pieces, by a library that releases the lock, or in a process of its own"
)


class GilWatch:
    """Reports which thread held the GIL, and in which line, when the GIL is free again."""

    def __init__(self, report: Callable[[int, str], None]) -> None:
        """`report(ident, text)` is called in a thread of the runtime."""
        self._report = report
        self._file = -1
        self._made: tuple[int, int] = (0, 0)
        self._write_later = faulthandler.dump_traceback_later

    def begin(self) -> None:
        """Start watching until the process ends; does nothing if the system cannot tell enough."""
        if not hasattr(os, "memfd_create") or voluntary_switches("self", threading.get_native_id()) is None:
            return
        try:
            self._file = move_to_high_descriptor(os.memfd_create(NAME))
        except OSError:  # no more descriptors are available
            return
        self._made = _identity(self._file)
        faulthandler.dump_traceback_later = self._for_the_program
        begun = _thread.allocate_lock()
        begun.acquire()

        def first() -> None:
            self._heartbeat()
            begun.release()

        unpatched.later(0.0, first)
        begun.acquire(True, FIRST_HEARTBEAT_TIMEOUT_S)

    def _for_the_program(self, *given: Any, **named: Any) -> None:
        """Leave the interpreter's only such thread to a program that asks for it."""
        self._file = -1
        self._write_later(*given, **named)

    def _heartbeat(self) -> None:
        if self._file < 0:
            return
        faulthandler.cancel_dump_traceback_later()
        try:
            if _identity(self._file) != self._made:
                return  # the program has closed it, and may have opened another file under its number
            text = os.pread(self._file, 1 << 20, 0).decode("ascii", "replace")
            me = threading.get_native_id()
            switches, now = voluntary_switches("self", me) or 0, unpatched.monotonic()
            held = holding_thread(text, switches, now)
            os.ftruncate(self._file, 0)
            os.lseek(self._file, 0, os.SEEK_SET)
            os.write(self._file, f"{me} {switches} {now}\n".encode())
        except OSError:
            return
        self._write_later(WRITTEN_S, file=self._file)
        unpatched.later(PERIOD_S, self._heartbeat)
        if held is not None:
            self._report(held.ident, TEXT.format(held.line))


def _identity(descriptor: int) -> tuple[int, int]:
    status = os.fstat(descriptor)
    return status.st_dev, status.st_ino


def move_to_high_descriptor(descriptor: int) -> int:
    """Move a descriptor to a high number, which programs that close all they know of leave alone; return it."""
    import fcntl
    import resource

    allowed = resource.getrlimit(resource.RLIMIT_NOFILE)[0]
    least = MIN_DESCRIPTOR if allowed < 0 else min(MIN_DESCRIPTOR, allowed - 16)
    moved = fcntl.fcntl(descriptor, fcntl.F_DUPFD_CLOEXEC, max(least, 3))
    os.close(descriptor)
    return moved
