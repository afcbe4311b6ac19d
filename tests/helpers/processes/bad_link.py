"""A link between a console and a router that can be cut, slowed down and spoilt: a proxy on loopback."""

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
"""Segments of one direction that may be under way at once, so that delay does not limit the rate."""
Segments = queue.Queue["tuple[float, bytes]"]
"""When each is due, and what it is; without bytes, the end."""
Spoil = Callable[[bytes], bytes]


class BadLink:
    """Passes on what comes at `port`; each direction holds every segment back for `delay` s, some for `hold` s more."""

    def __init__(self, to: int) -> None:
        self._to = to
        self.delay = 0.0
        self.hold, self.held_share = 0.0, 0.0
        self.spoil: Spoil | None = None
        self._random = random.Random(1)
        self._passing = threading.Event()
        self._passing.set()
        self._sockets: list[socket.socket] = []
        self._server = socket.create_server(("127.0.0.1", 0))
        self.port: int = self._server.getsockname()[1]
        threading.Thread(target=self._accept, daemon=True).start()

    def cut(self) -> None:
        """Nothing passes, in neither direction, and nobody is told: as with a cable that was pulled."""
        self._passing.clear()

    def hint(self) -> None:
        """All passes again, what has waited first."""
        self._passing.set()

    def break_connections(self) -> None:
        """Close all that is open; new connections are taken."""
        for each in self._sockets:
            with contextlib.suppress(OSError):
                each.shutdown(socket.SHUT_RDWR)

    def close(self) -> None:
        """Pass on nothing any more."""
        self._server.close()
        self.hint()
        self.break_connections()

    def _accept(self) -> None:
        with contextlib.suppress(OSError):
            while True:
                inner, _ = self._server.accept()
                try:
                    outer = socket.create_connection(("127.0.0.1", self._to))
                except OSError:
                    inner.close()
                    continue
                self._sockets += (inner, outer)
                for one, other in ((inner, outer), (outer, inner)):
                    one.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
                    under_way: Segments = queue.Queue(UNDER_WAY)
                    threading.Thread(target=self._take, args=(one, under_way), daemon=True).start()
                    threading.Thread(target=self._bring, args=(under_way, one, other), daemon=True).start()

    def _take(self, one: socket.socket, under_way: Segments) -> None:
        due = 0.0
        with contextlib.suppress(OSError):
            while data := one.recv(SEGMENT):
                held = self.hold if self._random.random() < self.held_share else 0.0
                due = max(due, time.monotonic() + self.delay + held)  # in order, as TCP delivers
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
        while data:  # whoever still reads is not to wait for room
            _, data = under_way.get()
