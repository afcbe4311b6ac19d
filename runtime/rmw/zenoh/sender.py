"""Sends messages that must not be dropped, in a thread, so that publishers do not wait for readers that do not read."""

from __future__ import annotations

import threading
from _thread import allocate_lock
from collections import deque

from bot_console.runtime.process import current
from bot_console.runtime.process.notices import notify
from bot_console.runtime.process.virtual.child_threads import start_outside
from bot_console.runtime.rmw.zenoh.congestion_control import WAIT_BEFORE_DROP_US
from bot_console.runtime.rmw.zenoh.declarations import Publisher

MAX_QUEUED_BYTES = 64_000_000
"""Capacity of the queue in bytes: more than is published before a hung process is cut off (`WAIT_BEFORE_CUT_US`)."""

BURST_MESSAGES, BURST_BYTES = 128, 4_000_000
"""Queued messages, or bytes, from which on a publisher lets the thread send all of them before it continues.

The thread releases the GIL with each message that it sends, and gets it back only after 5 ms while another thread
publishes without a pause: during a burst next to nothing was sent, and most images found no room in the queue.
"""
YIELD_TIMEOUT_S = WAIT_BEFORE_DROP_US * 1e-6
"""The longest wait of a publisher for that, in seconds: as long as other publishers wait for a full link. After an
unsuccessful wait the publisher does not wait again until the queue is empty, or until more than half of it is full and
the thread has sent something.
"""


class Sender:
    """The queue of a session's keep-all publishers, and the thread that drains it, started on first use.

    A message stays in the queue until it is sent, and only the thread removes messages. Publishers take the lock to
    append, the thread only when the queue is empty, so that they do not contend for it with each message.
    """

    def __init__(self) -> None:
        self._lock = allocate_lock()
        self._wake = allocate_lock()
        """Always held, except for the moment when the waiting thread is woken."""
        self._wake.acquire()
        self._queue: deque[tuple[Publisher, bytes, bytes]] = deque()
        self._accepted_bytes = 0
        self._dequeued_bytes = 0
        """Bytes accepted into the queue, and those of them no longer waiting; only one side writes each counter."""
        self._empty = threading.Event()
        self._empty.set()
        """Set by the thread when the queue is empty, cleared by whoever waits for that."""
        self._last_futile_wait: int | None = None
        """Value of `_dequeued_bytes` when a publisher last waited in vain for the queue to be sent."""
        self._waits = False
        self._ended = False
        self._thread: threading.Thread | None = None
        self._process = current()

    def send(self, publisher: Publisher, topic: str, payload: bytes, attachment: bytes) -> bool:
        """Queue a message; returns False if there is no room, which is reported once per topic."""
        queue = self._queue
        with self._lock:
            waiting = self._accepted_bytes - self._dequeued_bytes
            if waiting and waiting + len(payload) > MAX_QUEUED_BYTES:
                fits = False
            else:
                fits = True
                queue.append((publisher, payload, attachment))
                self._accepted_bytes += len(payload)
                if self._waits or self._thread is None:
                    self._start()
                waiting = self._accepted_bytes - self._dequeued_bytes
        if fits:
            if len(queue) >= BURST_MESSAGES or waiting >= BURST_BYTES:
                self._yield_to_thread(waiting)
        else:
            notify(
                self._process,
                f"messages of '{topic}' were dropped: {MAX_QUEUED_BYTES // 1_000_000} MB wait to be sent to processes "
                "that do not take them; publish less often, or end the reader that hangs",
            )
        return fits

    def _yield_to_thread(self, waiting: int) -> None:
        """Give the thread time to send the whole queue (`waiting` bytes), unless the last wait was in vain."""
        if self._last_futile_wait is None or (
            waiting > MAX_QUEUED_BYTES // 2 and self._dequeued_bytes != self._last_futile_wait
        ):
            self._last_futile_wait = None if self._wait_until_empty(YIELD_TIMEOUT_S) else self._dequeued_bytes

    def _start(self) -> None:
        """Wake or start the thread, since the queue is no longer empty; call with the lock held."""
        if self._waits:
            self._waits = False
            self._wake.release()
        elif self._thread is None and not self._ended:
            self._thread = threading.Thread(target=self._run, name="zenoh-sender", daemon=True)
            start_outside(self._thread)  # not of the node that happens to publish first, with which it would end

    def _wait_until_empty(self, timeout_s: float) -> bool:
        """Wait until the queue is sent, at most `timeout_s`; return whether it was."""
        with self._lock:
            if not self._queue:
                return True
            self._empty.clear()
        return self._empty.wait(timeout_s)

    def undeclare(self, publisher: Publisher) -> None:
        """Undeclare a publisher once all its messages have been sent."""
        with self._lock:
            # The queue is copied atomically, as the thread removes messages meanwhile.
            if any(each[0] is publisher for each in tuple(self._queue)) and not self._ended:
                self._queue.append((publisher, b"", b""))
                self._start()
                return
        publisher.undeclare()

    def _run(self) -> None:
        queue = self._queue
        while queue or self._has_more():
            publisher, payload, attachment = queue[0]
            self._dequeued_bytes += len(payload)
            if attachment:
                publisher.put_surely(payload, attachment)
            else:
                publisher.undeclare()
            queue.popleft()

    def _has_more(self) -> bool:
        """Wait until the empty queue receives something; return False when the sender ends."""
        while True:
            with self._lock:
                if self._queue:
                    return True
                self._last_futile_wait = None
                self._empty.set()
                if self._ended:
                    return False
                self._waits = True
            self._wake.acquire()

    def end(self, timeout_s: float) -> bool:
        """Stop the thread once the queue is sent, waiting at most `timeout_s`; return whether it was sent."""
        with self._lock:
            self._ended = True
            if self._waits:
                self._start()
        return self._wait_until_empty(timeout_s)
