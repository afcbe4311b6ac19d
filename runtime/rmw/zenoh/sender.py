"""Sends what must not be dropped, from a thread of its own: no publisher waits long for a reader that does not read."""

from __future__ import annotations

import threading
from _thread import allocate_lock
from collections import deque

from bot_console.runtime.process import current
from bot_console.runtime.process.notices import notify
from bot_console.runtime.rmw.zenoh.declared import Publisher
from bot_console.runtime.rmw.zenoh.settings import WAIT_BEFORE_DROP

ROOM = 64_000_000
"""How many bytes may wait to be sent: more than comes until a process that hangs is cut off (`WAIT_BEFORE_CUT`)."""

MANY, MUCH = 128, 4_000_000
"""Messages, or bytes, that wait when whoever publishes one more lets the thread send all of them before it goes on.

The thread gives the interpreter back with each message that it sends, and gets it again after 5 ms where somebody
publishes without a pause: next to nothing went out while a burst was published, and of images most found no room.
"""
LET_SEND = WAIT_BEFORE_DROP * 1e-6
"""Seconds for which it does so at most: as long as other publishers wait for a link that is full. After a vain wait it
goes on without until nothing waits any more, or more than half of the room is taken and the thread has sent something.
"""


class Sender:
    """The queue before the keep-all publishers of a session, and the thread that empties it, made at first use.

    What is just being sent stays in the queue until it is. That thread alone takes from it, and the lock is taken by
    those who put into it, and by the thread where nothing is left: both meet there, and not at each message.
    """

    def __init__(self) -> None:
        self._lock = allocate_lock()
        self._wake = allocate_lock()
        """Held but for the moment in which the thread that waits is woken."""
        self._wake.acquire()
        self._queue: deque[tuple[Publisher, bytes, bytes]] = deque()
        self._taken = 0
        self._begun = 0
        """Bytes that were taken, and those of them that do not wait any more: each is counted by one side alone."""
        self._emptied = threading.Event()
        self._emptied.set()
        """Set by the thread where nothing is left, cleared by who waits for that."""
        self._late: int | None = None
        """What `_begun` was when the thread was let send all that waited in vain."""
        self._waits = False
        self._ended = False
        self._thread: threading.Thread | None = None
        self._process = current()

    def send(self, publisher: Publisher, topic: str, payload: bytes, attachment: bytes) -> bool:
        """Have a message sent after all that came before; False where there is no room, which is told once a topic."""
        queue = self._queue
        with self._lock:
            waiting = self._taken - self._begun
            if waiting and waiting + len(payload) > ROOM:
                fits = False
            else:
                fits = True
                queue.append((publisher, payload, attachment))
                self._taken += len(payload)
                if self._waits or self._thread is None:
                    self._start()
                waiting = self._taken - self._begun
        if fits:
            if len(queue) >= MANY or waiting >= MUCH:
                self._let_send(waiting)
        else:
            notify(
                self._process,
                f"messages of '{topic}' were dropped: {ROOM // 1_000_000} MB wait to be sent to processes "
                "that do not take them; publish less often, or end the reader that hangs",
            )
        return fits

    def _let_send(self, waiting: int) -> None:
        """Give the thread time to send all that waits, `waiting` bytes, unless that was in vain."""
        if self._late is None or (waiting > ROOM // 2 and self._begun != self._late):
            self._late = None if self._is_emptied(LET_SEND) else self._begun

    def _start(self) -> None:
        """Have the thread look at the queue, which has something now; with the lock held."""
        if self._waits:
            self._waits = False
            self._wake.release()
        elif self._thread is None and not self._ended:
            self._thread = threading.Thread(target=self._run, name="zenoh-sender", daemon=True)
            self._thread.start()

    def _is_emptied(self, patience: float) -> bool:
        """Whether all is sent within `patience` (s)."""
        with self._lock:
            if not self._queue:
                return True
            self._emptied.clear()
        return self._emptied.wait(patience)

    def undeclare(self, publisher: Publisher) -> None:
        """Take a publisher back once all that it has published was sent."""
        with self._lock:
            # Copied at once: the thread takes from it meanwhile.
            if any(each[0] is publisher for each in tuple(self._queue)) and not self._ended:
                self._queue.append((publisher, b"", b""))
                self._start()
                return
        publisher.undeclare()

    def _run(self) -> None:
        queue = self._queue
        while queue or self._has_more():
            publisher, payload, attachment = queue[0]
            self._begun += len(payload)
            if attachment:
                publisher.put_surely(payload, attachment)
            else:
                publisher.undeclare()
            queue.popleft()

    def _has_more(self) -> bool:
        """Whether something more was put into the empty queue, which is waited for; False at the end."""
        while True:
            with self._lock:
                if self._queue:
                    return True
                self._late = None
                self._emptied.set()
                if self._ended:
                    return False
                self._waits = True
            self._wake.acquire()

    def end(self, patience: float) -> bool:
        """Take nothing more, and wait at most `patience` (s) until all is sent; whether it was."""
        with self._lock:
            self._ended = True
            if self._waits:
                self._start()
        return self._is_emptied(patience)
