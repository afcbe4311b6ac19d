"""A link between a console and a router that can be cut, delayed and disturbed: a proxy on loopback."""

from __future__ import annotations

import contextlib
import queue
import random
import socket
import threading
import time
from collections.abc import Callable

SEGMENT = 1400
UNDER_WAY = 1000
"""Segments per direction that may be in transit at once: enough that the delay does not limit the rate."""
NARROW_BUFFER = 4096
"""Receive buffer of a narrow link's sockets in bytes (Linux doubles it)."""
Segments = queue.Queue["tuple[float, bytes]"]
"""Segments with the time when each is due; empty bytes mark the end."""
Spoil = Callable[[bytes], bytes]


class BadLink:
    """Forwards what arrives at `port`; in each direction every segment is delayed by `delay` s, and some by `hold` s
    more. With a `rate` (bytes/s), it also carries no more than that and buffers little.
    """

    def __init__(self, to: int, rate: float = 0.0) -> None:
        self._to = to
        self._rate = rate
        self.connections = 0
        """How many connections have been accepted so far."""
        self.delay = 0.0
        self.hold, self.held_share = 0.0, 0.0
        self.spoil: Spoil | None = None
        self._random = random.Random(1)
        self._passing = threading.Event()
        self._passing.set()
        self._sockets: list[socket.socket] = []
        self._server = socket.create_server(("127.0.0.1", 0))
        if rate:
            self._server.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, NARROW_BUFFER)
        self.port: int = self._server.getsockname()[1]
        threading.Thread(target=self._accept, daemon=True).start()

    def cut(self) -> None:
        """Forward nothing in either direction, unnoticed by both sides, as if a cable had been pulled."""
        self._passing.clear()

    def restore(self) -> None:
        """Forward everything again, beginning with what has waited."""
        self._passing.set()

    def break_connections(self) -> None:
        """Close all open connections; new ones are accepted."""
        for each in self._sockets:
            with contextlib.suppress(OSError):
                each.shutdown(socket.SHUT_RDWR)

    def close(self) -> None:
        """Stop forwarding."""
        self._server.close()
        self.restore()
        self.break_connections()

    def _accept(self) -> None:
        with contextlib.suppress(OSError):
            while True:
                inner, _ = self._server.accept()
                self.connections += 1
                outer = socket.socket()
                if self._rate:
                    outer.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, NARROW_BUFFER)
                try:
                    outer.connect(("127.0.0.1", self._to))
                except OSError:
                    inner.close()
                    outer.close()
                    continue
                self._sockets += (inner, outer)
                for one, other in ((inner, outer), (outer, inner)):
                    one.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
                    under_way: Segments = queue.Queue(1 if self._rate else UNDER_WAY)
                    threading.Thread(target=self._take, args=(one, under_way), daemon=True).start()
                    threading.Thread(target=self._bring, args=(under_way, one, other), daemon=True).start()

    def _take(self, one: socket.socket, under_way: Segments) -> None:
        due = 0.0
        with contextlib.suppress(OSError):
            while data := one.recv(SEGMENT):
                held = self.hold if self._random.random() < self.held_share else 0.0
                due = max(due, time.monotonic() + self.delay + held)  # in order, as TCP delivers
                if self._rate:
                    due += len(data) / self._rate
                under_way.put((due, data))
                self._passing.wait()
        under_way.put((0.0, b""))

    def _bring(self, under_way: Segments, one: socket.socket, other: socket.socket) -> None:
        data = b" "
        with contextlib.suppress(OSError):
            while data:
                due, data = under_way.get()
                time.sleep(max(0.0, due - time.monotonic()))
                self._passing.wait()
                other.sendall(self.spoil(data) if self.spoil else data)
        for each in (one, other):
            with contextlib.suppress(OSError):
                each.shutdown(socket.SHUT_RDWR)
        while data:  # a side that still reads must not wait for buffer space
            _, data = under_way.get()
