"""Exchanges JSON objects, one per line, over a stream socket in both directions, without ever blocking the sender."""

from __future__ import annotations

import json
import socket
import threading
from collections import deque
from collections.abc import Callable, Mapping
from typing import Any

Message = Mapping[str, Any]

SPARE_BYTES = 4 << 20
"""If more bytes than this are queued, expendable messages are dropped and counted."""
MAX_MESSAGE_BYTES = 64 << 20
"""If more bytes than this are queued, the connection to the slow reader is closed."""


class Channel:
    """A connection with a reading thread and a writing thread."""

    def __init__(
        self, connection: socket.socket, received: Callable[[Message], None], lost: Callable[[], None]
    ) -> None:
        """`received` is called in the reading thread; `lost` once, when either side closes the connection."""
        self._socket = connection
        self._received = received
        self._lost = lost
        self._news = threading.Condition()
        self._waiting: deque[bytes] = deque()
        self._bytes = self._dropped = 0
        self._closed = False
        self._threads = [
            threading.Thread(target=each, name="launch host", daemon=True) for each in (self._read, self._write)
        ]

    def start(self) -> None:
        """Start reading and writing."""
        for each in self._threads:
            each.start()

    def send(self, message: Message, *, spare: bool = False) -> None:
        """Queue a message; a `spare` message is dropped if the other side does not read fast enough."""
        line = json.dumps(message).encode() + b"\n"
        with self._news:
            if self._closed:
                return
            if spare and self._bytes > SPARE_BYTES:
                self._dropped += 1
                return
            if self._bytes > MAX_MESSAGE_BYTES:
                self._shut()
                return
            if self._dropped:
                reported = json.dumps({"dropped": self._dropped}).encode() + b"\n"
                self._dropped = 0
                line = reported + line
            self._waiting.append(line)
            self._bytes += len(line)
            self._news.notify()

    def close(self, timeout_s: float = 1.0) -> None:
        """Write the queued messages, for at most `timeout_s`, then disconnect; a second call does nothing."""
        with self._news:
            self._news.wait_for(lambda: self._closed or not self._bytes, timeout_s)
            self._shut()

    def _shut(self) -> None:
        self._closed = True
        self._news.notify_all()
        try:
            self._socket.shutdown(socket.SHUT_RDWR)
        except OSError:  # the other side disconnected first
            return

    def _read(self) -> None:
        try:
            with self._socket.makefile("rb") as lines:
                for line in lines:
                    self._received(json.loads(line))
        except (OSError, ValueError):  # disconnected, or the other side is no launch host
            pass
        finally:
            with self._news:
                self._shut()
            self._socket.close()
            self._lost()

    def _write(self) -> None:
        while True:
            with self._news:
                self._news.wait_for(lambda: self._closed or self._waiting)
                if self._closed:
                    return
                line = self._waiting.popleft()
            try:
                self._socket.sendall(line)
            except OSError:  # the reading thread notices it as well
                with self._news:
                    self._shut()
                return
            with self._news:
                self._bytes -= len(line)
                self._news.notify_all()
