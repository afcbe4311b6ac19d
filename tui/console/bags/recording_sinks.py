"""The sinks for recorded messages: a bag, from start to stop, or the ring buffer of the last minutes."""

from __future__ import annotations

import math
from contextlib import suppress
from typing import Any

from bot_console.tui.console.bags.recorder import Sink
from bot_console.tui.console.bags.snapshot_ring import Ring
from bot_console.tui.console.bags.writer import BagWriter
from bot_console.tui.files.save_file import NotSaved

LOG = "/rosout"
"""Publishers latch this topic, but its last message is a line of the log, not a state."""


class RecordingSink:
    """Keeps what every bag must begin with: the topics, and the latest messages of latched topics."""

    def __init__(self) -> None:
        self._topics: dict[str, tuple[Any, list[dict[str, Any]], str]] = {}
        self._latching: set[str] = set()
        self._latest: dict[str, tuple[bytes, int]] = {}

    def topic(self, name: str, kind: Any, qos: list[dict[str, Any]], type_hash: str = "") -> None:
        """Add a topic."""
        self._topics[name] = kind, qos, type_hash
        if name != LOG and any(each.get("durability") == "transient_local" for each in qos):
            self._latching.add(name)

    def write(self, topic: str, data: bytes, received: int, sent: int) -> None:
        """Add a message."""
        if topic in self._latching:
            self._latest[topic] = data, received

    def _open(self, bag: Sink, begin: int, before: float = math.inf) -> None:
        """Write the beginning of a bag: topics, and latched messages from before a time (ns since the epoch)."""
        for name, (kind, qos, type_hash) in self._topics.items():
            bag.topic(name, kind, qos, type_hash)
        for name, (data, received) in self._latest.items():
            if received < before:
                bag.write(name, data, begin, 0)


class BagSink(RecordingSink):
    """Writes messages into a bag while there is one, in the recorder's thread."""

    def __init__(self) -> None:
        super().__init__()
        self.writer: BagWriter | None = None
        self.problem = ""
        """Why a bag was closed without a request, for instance because the disk is full."""

    def begin(self, writer: BagWriter, now: int) -> None:
        """Start writing a bag; `now` is in ns since the epoch."""
        self._open(writer, now)
        self.writer, self.problem = writer, ""

    def end(self) -> BagWriter | None:
        """Close the bag and return it; raises `OSError` if it cannot be written completely."""
        writer, self.writer = self.writer, None
        if writer is not None:
            writer.close()
        return writer

    def fail(self, problem: str) -> None:
        """Close the bag with what it contains, and keep the reason in `problem`."""
        with suppress(OSError, NotSaved):
            self.end()
        self.problem = problem

    def topic(self, name: str, kind: Any, qos: list[dict[str, Any]], type_hash: str = "") -> None:
        """Add a topic."""
        if self.writer is not None:
            self.writer.topic(name, kind, qos, type_hash)
        # only now: a topic that this bag rejects must not be added to the next one either
        super().topic(name, kind, qos, type_hash)

    def write(self, topic: str, data: bytes, received: int, sent: int) -> None:
        """Add a message."""
        super().write(topic, data, received, sent)
        if self.writer is not None:
            try:
                self.writer.write(topic, data, received, sent)
            except OSError as error:
                self._fail(error)

    def flush(self) -> None:
        """Pass buffered data to the operating system."""
        if self.writer is not None:
            try:
                self.writer.flush()
            except OSError as error:
                self._fail(error)

    def _fail(self, error: OSError) -> None:
        writer, self.writer = self.writer, None
        folder = writer.folder if writer is not None else ""
        self.problem = f"recording into {folder} has ended: {error.strerror or error}"


class RingSink(RecordingSink):
    """Keeps the last minutes in memory until they are requested."""

    def __init__(self, ring: Ring) -> None:
        super().__init__()
        self.ring = ring

    def pour(self, writer: BagWriter) -> int:
        """Write the kept messages to a bag; returns their number."""
        self._open(writer, self.ring.begin, before=self.ring.begin)
        return self.ring.pour(writer)

    def topic(self, name: str, kind: Any, qos: list[dict[str, Any]], type_hash: str = "") -> None:
        """Add a topic."""
        super().topic(name, kind, qos, type_hash)
        self.ring.topic(name, kind, qos, type_hash)

    def write(self, topic: str, data: bytes, received: int, sent: int) -> None:
        """Add a message."""
        super().write(topic, data, received, sent)
        self.ring.write(topic, data, received, sent)
