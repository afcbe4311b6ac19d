"""Frames of plain data on the socket between the coordinator of a stepped run and one of its processes.

The coordinator sends *grants*: (now, horizon, operations). The process sends *answers*: (now, due, operations, stalls).
Times are the run's steady times in ns. An operation is a tuple whose first item is its name; all but `SIGNAL` belong to
the middleware. The first frame is a `Welcome`.
"""

from __future__ import annotations

import marshal
import socket
import struct
from typing import Any, NamedTuple

_LENGTH = struct.Struct("!I")
_MAX_READ_BYTES = 1 << 18
SIGNAL = "signal"
"""The operation (`SIGNAL`, number): delivers a signal to the process."""

Operation = tuple[Any, ...]


class Welcome(NamedTuple):
    """The data that a process receives when it joins a run."""

    system_offset: int
    """System time (ns) at steady time 0."""
    stall_s: float
    seed: int
    """The seed of its random number generators."""
    processors: list[int]
    """The processors that the run is pinned to; empty if it is not pinned."""


class Channel:
    """One end of the connection."""

    def __init__(self, connection: socket.socket) -> None:
        self._connection = connection
        self._rest = b""

    def fileno(self) -> int:
        """Return its descriptor."""
        return self._connection.fileno()

    def send(self, frame: Any) -> None:
        """Send a frame; raises `OSError` if the other end is closed."""
        data = marshal.dumps(frame)
        self._connection.sendall(_LENGTH.pack(len(data)) + data)

    def receive(self) -> Any:
        """Return the next frame, waiting for it; None at the end."""
        while True:
            rest = self._rest
            if len(rest) >= _LENGTH.size:
                end = _LENGTH.unpack_from(rest)[0] + _LENGTH.size
                if len(rest) >= end:
                    self._rest = rest[end:]
                    return marshal.loads(rest[_LENGTH.size : end])
            try:
                data = self._connection.recv(_MAX_READ_BYTES)
            except ConnectionError:  # the process was killed with unread data
                return None
            if not data:
                return None
            self._rest = rest + data if rest else data

    def close(self) -> None:
        """Close this end."""
        self._connection.close()
