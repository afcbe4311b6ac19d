"""Keeps the last minutes of the messages that a process handles, so that they can be saved after an event."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable
from concurrent.futures import Future
from typing import Any, Protocol

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.bags.missing_packages import MissingPackageError
from bot_console.tui.console.bags.qos import offered_entries
from bot_console.tui.console.bags.recorder import CLOCK, in_order
from bot_console.tui.console.bags.recording_sinks import RingSink
from bot_console.tui.console.bags.snapshot_ring import Ring
from bot_console.tui.console.bags.snapshot_size import SnapshotSize
from bot_console.tui.console.bags.writer import BagWriter
from bot_console.tui.console.in_background import in_background
from bot_console.tui.files.save_file import NotSaved, typed_path
from bot_console.tui.text.counted import counted

TURN_S = 0.25
"""Seconds between two rounds of processing."""
MAX_WAITING_MESSAGES = 50_000
"""Messages that may arrive between two rounds; beyond that, the oldest are dropped."""


class MessageEndpoint(Protocol):
    """The endpoint through which a message passed."""

    topic: str
    message_class: Any
    qos: Any


class SnapshotBuffer:
    """Keeps the messages passed to it; methods may be called from any thread.

    The middleware hands over messages it handles anyway, so there is no subscription: `topic info` does not count one,
    and a node that publishes only while it has subscribers does not start publishing.
    """

    def __init__(self, size: SnapshotSize, serialize: Callable[[Any], bytes], hash_of: Callable[[Any], str]) -> None:
        """`serialize` returns the CDR bytes of a message, `hash_of` the RIHS01 hash of a message class."""
        self.kept_s = size.seconds
        self._serialize = serialize
        self._hash_of = hash_of
        self._sink = RingSink(Ring(size.seconds, size.bytes))
        self._waiting: deque[tuple[MessageEndpoint, bytes, int, int, Any]] = deque(maxlen=MAX_WAITING_MESSAGES)
        self._numbers: dict[bytes, int] = {}
        self._known: set[str] = set()
        self._last = 0
        self._lock = threading.Lock()
        self._closing = threading.Event()
        threading.Thread(target=self._serve, name="snapshot-buffer", daemon=True).start()

    def hear(self, by: MessageEndpoint, source: bytes, number: int, sent: int, message: Any) -> None:
        """Keep a message. `by` is its endpoint, `source` the publisher's gid, `number` its sequence number, `sent` in
        ns.

        `message` is a message object or serialized bytes.
        """
        if by.topic != CLOCK:
            self._waiting.append((by, source, number, sent, message))

    def keep(self, folder: str) -> Future[Answer]:
        """Save the kept messages as a new bag, and continue keeping."""
        return in_background(lambda: self._write_bag(folder), "keep")

    def close(self) -> None:
        """Stop keeping messages."""
        self._closing.set()

    def _write_bag(self, folder: str) -> Answer:
        try:
            with self._lock:
                self._turn()
                writer = BagWriter(typed_path(folder))
                count = self._sink.pour(writer)
                span = self._sink.ring.span
            writer.close()
        except (MissingPackageError, NotSaved, OSError) as error:
            return Answer(False, f"not saved: {error}")
        return Answer(True, f"the last {span:.0f} s, {counted(count, 'message')}, in {folder}")

    def _serve(self) -> None:
        while not self._closing.wait(TURN_S):
            with self._lock:
                self._turn()

    def _turn(self) -> None:
        """Process the messages that have arrived: serialize them, since bytes are smaller and cost the garbage
        collector nothing.
        """
        found: list[tuple[int, str, bytes]] = []
        for _ in range(len(self._waiting)):
            by, source, number, sent, message = self._waiting.popleft()
            if number <= self._numbers.get(source, 0):  # already received through another subscription of this process
                continue
            self._numbers[source] = number
            if by.topic not in self._known:
                self._known.add(by.topic)
                self._sink.topic(by.topic, by.message_class, offered_entries([by.qos]), self._hash_of(by.message_class))
            found.append((sent, by.topic, message if isinstance(message, bytes) else self._serialize(message)))
        for received, topic, data, sent in in_order(found, time.time_ns(), self._last):
            self._last = received
            self._sink.write(topic, data, received, sent)
