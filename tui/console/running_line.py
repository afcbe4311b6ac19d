"""The latest output of a command line that is running. Standard library only."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Sequence

MAX_LINES = 200
"""The number of output lines kept."""


class RunningLine:
    """Collects the output of a line; any thread may append to it."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._lines: deque[str] = deque(maxlen=MAX_LINES)
        self._rest = ""
        self._reported: tuple[str, ...] = ()
        self._new = False
        self.ended = False

    def append(self, text: str) -> None:
        """Add printed text, in pieces of any size."""
        with self._lock:
            *lines, self._rest = (self._rest + text).split("\n")
            self._lines.extend(lines)
            self._new = True

    def end(self) -> None:
        """Mark the line as ended."""
        with self._lock:
            if self._rest:
                self._lines.append(self._rest)
            self._rest, self._new, self.ended = "", True, True

    def lines(self) -> Sequence[str]:
        """The last lines of output; the same object until there are more."""
        with self._lock:
            if self._new:
                self._new, self._reported = False, tuple(self._lines)
            return self._reported
