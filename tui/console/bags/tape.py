"""Where a recorder's messages go: into the ring of the last minutes, into a bag, both or neither."""

from __future__ import annotations

from typing import Any

from bot_console.tui.console.bags.recorder import Ring
from bot_console.tui.console.bags.writer import BagWriter

LOG = "/rosout"
"""A latching topic whose last message is no state: a line of the log."""


class Tape:
    """A sink that can be switched while a recorder runs, in the recorder's thread."""

    def __init__(self, ring: Ring | None) -> None:
        self.ring = ring
        self.writer: BagWriter | None = None
        self.problem = ""
        """Why a bag has ended by itself, for instance that the disk is full."""
        self._topics: dict[str, tuple[Any, list[dict[str, Any]], str]] = {}
        self._latching: set[str] = set()
        self._latest: dict[str, tuple[bytes, int]] = {}

    def begin(self, writer: BagWriter, now: int) -> None:
        """Write a bag from now on (ns since the epoch); what latching publishers said last stands at its begin."""
        for name, (kind, qos, type_hash) in self._topics.items():
            writer.topic(name, kind, qos, type_hash)
        for name, (data, _) in self._latest.items():
            writer.write(name, data, now, 0)
        self.writer, self.problem = writer, ""

    def pour(self, writer: BagWriter) -> int:
        """Write what is kept in memory, with what latching publishers had said before it; the number of messages."""
        if self.ring is None:
            return 0
        begin = self.ring.begin
        for name, (kind, qos, type_hash) in self._topics.items():
            writer.topic(name, kind, qos, type_hash)
        for name, (data, received) in self._latest.items():
            if received < begin:
                writer.write(name, data, begin, 0)
        return self.ring.pour(writer)

    def end(self) -> BagWriter | None:
        """Finish the bag and give it; raises `OSError` where the disk takes no more."""
        writer, self.writer = self.writer, None
        if writer is not None:
            writer.close()
        return writer

    def topic(self, name: str, kind: Any, qos: list[dict[str, Any]], type_hash: str = "") -> None:
        """Begin a topic."""
        self._topics[name] = kind, qos, type_hash
        if name != LOG and any(each.get("durability") == "transient_local" for each in qos):
            self._latching.add(name)
        for each in (self.ring, self.writer):
            if each is not None:
                each.topic(name, kind, qos, type_hash)

    def write(self, topic: str, data: bytes, received: int, sent: int) -> None:
        """Add a message."""
        if self.ring is not None:
            self.ring.write(topic, data, received, sent)
        if topic in self._latching:
            self._latest[topic] = data, received
        if self.writer is not None:
            try:
                self.writer.write(topic, data, received, sent)
            except OSError as error:
                self._fail(error)

    def flush(self) -> None:
        """Hand what is held to the system."""
        if self.writer is not None:
            try:
                self.writer.flush()
            except OSError as error:
                self._fail(error)

    def _fail(self, error: OSError) -> None:
        writer, self.writer = self.writer, None
        folder = writer.folder if writer is not None else ""
        self.problem = f"{folder} is recorded no further: {error.strerror or error}"
