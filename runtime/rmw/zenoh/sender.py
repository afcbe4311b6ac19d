"""Sends what must not be dropped, from a thread of its own: no publisher waits for a reader that does not read."""

from __future__ import annotations

import threading
from collections import deque

from bot_console.runtime.process import current
from bot_console.runtime.process.notices import notify
from bot_console.runtime.rmw.zenoh.declared import Publisher

ROOM = 64_000_000
"""How many bytes may wait to be sent: more than comes until a process that hangs is cut off (`WAIT_BEFORE_CUT`)."""


class Sender:
    """The queue before the keep-all publishers of a session, and the thread that empties it, made at first use."""

    def __init__(self) -> None:
        self._changed = threading.Condition()
        self._queue: deque[tuple[Publisher, str, bytes, bytes]] = deque()
        self._bytes = 0
        self._busy = False
        self._ended = False
        self._thread: threading.Thread | None = None
        self._process = current()

    def send(self, publisher: Publisher, topic: str, payload: bytes, attachment: bytes) -> bool:
        """Have a message sent after all that came before; False where there is no room, which is told once a topic."""
        with self._changed:
            fits = self._bytes + len(payload) <= ROOM or not self._queue
            if fits:
                self._append(publisher, topic, payload, attachment)
        if not fits:
            notify(
                self._process,
                f"messages of '{topic}' were dropped: {ROOM // 1_000_000} MB wait to be sent to processes "
                "that do not take them; publish less often, or end the reader that hangs",
            )
        return fits

    def _append(self, publisher: Publisher, topic: str, payload: bytes, attachment: bytes) -> None:
        self._queue.append((publisher, topic, payload, attachment))
        self._bytes += len(payload)
        if self._thread is None and not self._ended:
            self._thread = threading.Thread(target=self._run, name="zenoh-sender", daemon=True)
            self._thread.start()
        self._changed.notify_all()

    def undeclare(self, publisher: Publisher) -> None:
        """Take a publisher back once all that it has published was sent."""
        with self._changed:
            waits = any(each[0] is publisher for each in self._queue) or self._busy
            if waits and not self._ended:
                self._append(publisher, "", b"", b"")
                return
        publisher.undeclare()

    def _run(self) -> None:
        while True:
            with self._changed:
                self._busy = False
                self._changed.notify_all()
                while not self._queue:
                    if self._ended:
                        return
                    self._changed.wait()
                publisher, _, payload, attachment = self._queue.popleft()
                self._bytes -= len(payload)
                self._busy = True
            if attachment:
                publisher.put_surely(payload, attachment)
            else:
                publisher.undeclare()

    def end(self, patience: float) -> bool:
        """Take nothing more, and wait at most `patience` (s) until all is sent; whether it was."""
        with self._changed:
            self._ended = True
            self._changed.notify_all()
            return self._changed.wait_for(lambda: not self._queue and not self._busy, patience)
