"""A real file descriptor that feeds a captured stream, for the output of a node's child processes and C code."""

from __future__ import annotations

import codecs
import os
import select
import threading
from _thread import RLock
from collections.abc import Callable

from ..virtual.child_threads import start_outside

DRAIN_TIMEOUT_S = 0.5
"""How long (s) the end of a process waits for the last output of its child processes."""
CHUNK = 65536


class OutputPipe:
    """Passes on text written to `write_end`."""

    def __init__(self, take: Callable[[str], None]) -> None:
        self._take = take
        self._read_end, self.write_end = os.pipe()
        self._guard = RLock()
        self._decode = codecs.getincrementaldecoder("utf-8")(errors="replace").decode
        self._ended = False
        if os.name == "posix":
            os.set_blocking(self._read_end, False)
        self._pump = threading.Thread(target=self._run, name="output pump", daemon=True)
        # Belongs to no node process: it must live until the last child of the node has printed.
        start_outside(self._pump)

    def drain(self) -> None:
        """Pass on what is in the pipe now, so that it precedes what is printed next."""
        if os.name != "posix":
            return
        with self._guard:
            try:
                while not self._ended and (data := os.read(self._read_end, CHUNK)):
                    self._take(self._decode(data))
            except BlockingIOError:
                return
            self._ended = True

    def close(self) -> None:
        """Close our end. What children have written arrives; a child that keeps printing is not waited for."""
        os.close(self.write_end)
        self._pump.join(DRAIN_TIMEOUT_S)

    def _run(self) -> None:
        while not self._ended:
            if os.name == "posix":
                select.select([self._read_end], [], [])
                self.drain()
            elif data := os.read(self._read_end, CHUNK):
                self._take(self._decode(data))
            else:
                break
        os.close(self._read_end)
