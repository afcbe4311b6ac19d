"""Reads an MCAP file: by its index or, if that is missing or incomplete, by scanning the file once."""

from __future__ import annotations

import heapq
import os
import re
import struct
from array import array
from collections import Counter
from collections.abc import Collection, Iterator
from pathlib import Path
from typing import BinaryIO, NamedTuple

from bot_console.tui.console.bags import mcap_records as records
from bot_console.tui.console.bags.mcap_records import MAGIC, Place, StoredMessage, Tables
from bot_console.tui.console.bags.metadata import Topic, qos_profiles
from mcap.opcode import Opcode

TWO_PARTS = re.compile(r"(\w+)/(\w+)")
"""A message type without the `msg` between package and name, as some programs write it."""


class Chunk(NamedTuple):
    """A chunk: its first and last time (ns since the epoch), its place, and its channels (empty: unknown)."""

    begin: int
    end: int
    place: Place
    channels: Collection[int]


class McapFile:
    """The contents of an MCAP file. Raises `ValueError` and the like if it is damaged."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._tables = Tables()
        self._chunks: list[Chunk] = []
        self._times, self._begins, self._lengths = array("Q"), array("Q"), array("Q")
        """For the messages outside chunks: times of reception (ns), positions and lengths of the records."""
        self.counts: Counter[int] = Counter()
        self.begin, self.end = 0, 0
        """Times of the first and last message (ns since the epoch); 0 if there is none."""
        with path.open("rb") as file:
            if file.read(len(MAGIC)) != MAGIC:
                raise ValueError("it is not an MCAP file")
            size = file.seek(0, os.SEEK_END)
            if not self._read_summary(file, size):
                self._search(file, size)

    def topics(self) -> Iterator[Topic]:
        """The topics of the channels; a topic with several channels is yielded several times."""
        for id, channel in self._tables.channels.items():
            schema = self._tables.schemas.get(channel.schema_id)
            name = schema.name if schema is not None else ""
            two = TWO_PARTS.fullmatch(name) if schema is not None and schema.encoding.startswith("ros2") else None
            facts = channel.metadata
            yield Topic(
                channel.topic,
                f"{two[1]}/msg/{two[2]}" if two else name,
                qos_profiles(facts.get("offered_qos_profiles", "")),
                facts.get("topic_type_hash", ""),
                self.counts[id],
                channel.message_encoding or "cdr",
            )

    def messages(self, topics: Collection[str] | None, begin: int) -> Iterator[tuple[int, str, bytes]]:
        """The messages received since a time, in order: (time of reception in ns, topic, data)."""
        names = {id: each.topic for id, each in self._tables.channels.items()}
        wanted = {id for id, name in names.items() if topics is None or name in topics}
        with self._path.open("rb") as chunks, self._path.open("rb") as loose:
            found = heapq.merge(
                self._chunk_messages(chunks, begin, wanted), self._unchunked_messages(loose), key=_received
            )
            for each in found:
                if each.channel not in names:
                    raise ValueError(f"a message belongs to the unknown channel {each.channel}")
                if each.received >= begin and each.channel in wanted:
                    yield each.received, names[each.channel], each.data

    def _read_summary(self, file: BinaryIO, size: int) -> bool:
        """Read the index at the end of the file; returns whether it is complete."""
        footer = size - len(MAGIC) - records.FOOTER_BYTES
        if footer < len(MAGIC):
            return False
        file.seek(footer)
        opcode, _, begin = struct.unpack("<BQQ", file.read(17))
        if opcode != Opcode.FOOTER or not len(MAGIC) <= begin < footer:
            return False
        tables = Tables()
        for each in records.places(file, begin, footer):
            tables.add(each.opcode, each.content(file))
        figures = tables.statistics
        if not tables.complete or figures is None:
            return False
        self._tables = tables
        self.counts.update(figures.channel_message_counts)
        if figures.message_count:
            self.begin, self.end = figures.message_start_time, figures.message_end_time
        for index in tables.chunks:
            begin = index.chunk_start_offset + records.HEAD.size
            place = Place(Opcode.CHUNK, begin, index.chunk_length - records.HEAD.size)
            if not 0 < place.length <= size - begin:
                raise ValueError("its index refers to a place behind its end")
            channels = index.message_index_offsets.keys()
            self._chunks.append(Chunk(index.message_start_time, index.message_end_time, place, channels))
        return True

    def _search(self, file: BinaryIO, size: int) -> None:
        """Scan the file for schemas, channels and messages, and build an index of them."""
        for each in records.places(file, len(MAGIC), size):
            if each.opcode in (Opcode.DATA_END, Opcode.FOOTER):
                break
            if each.opcode in (Opcode.SCHEMA, Opcode.CHANNEL):
                self._tables.add(each.opcode, each.content(file))
            elif each.opcode == Opcode.MESSAGE:
                head = Place(each.opcode, each.begin, records.MESSAGE.size).content(file)
                found = records.message(head)
                self._count(found)
                self._times.append(found.received)
                self._begins.append(each.begin)
                self._lengths.append(each.length)
            elif each.opcode == Opcode.CHUNK:
                self._search_chunk(file, each)

    def _search_chunk(self, file: BinaryIO, place: Place) -> None:
        times: list[int] = []
        channels: set[int] = set()
        for opcode, content in records.chunk_records(place.content(file)):
            if opcode == Opcode.MESSAGE:
                found = records.message(content)
                self._count(found)
                times.append(found.received)
                channels.add(found.channel)
            else:
                self._tables.add(opcode, content)
        if times:
            self._chunks.append(Chunk(min(times), max(times), place, channels))

    def _count(self, found: StoredMessage) -> None:
        self.counts[found.channel] += 1
        self.begin = min(self.begin or found.received, found.received)
        self.end = max(self.end, found.received)

    def _chunk_messages(self, file: BinaryIO, begin: int, wanted: Collection[int]) -> Iterator[StoredMessage]:
        """The messages inside chunks, in order. Overlapping chunks are held in memory as long as necessary."""
        waiting: list[tuple[int, int, StoredMessage]] = []
        number = 0
        for chunk in sorted(self._chunks, key=lambda each: each.begin):
            if chunk.end < begin or (chunk.channels and not any(each in wanted for each in chunk.channels)):
                continue
            while waiting and waiting[0][0] <= chunk.begin:
                yield heapq.heappop(waiting)[2]
            for opcode, content in records.chunk_records(chunk.place.content(file)):
                if opcode == Opcode.MESSAGE:
                    found = records.message(content)
                    number += 1
                    heapq.heappush(waiting, (found.received, number, found))
        while waiting:
            yield heapq.heappop(waiting)[2]

    def _unchunked_messages(self, file: BinaryIO) -> Iterator[StoredMessage]:
        """The messages outside chunks, in order."""
        for at in sorted(range(len(self._times)), key=self._times.__getitem__):
            yield records.message(Place(Opcode.MESSAGE, self._begins[at], self._lengths[at]).content(file))


def _received(each: StoredMessage) -> int:
    return each.received
