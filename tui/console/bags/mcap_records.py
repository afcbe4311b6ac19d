"""The records of an MCAP file, found without an index. A record's length is checked against the size of the file."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from io import BytesIO
from typing import BinaryIO, NamedTuple

from bot_console.tui.console.bags.compression import unpack_chunk
from mcap.data_stream import ReadDataStream
from mcap.opcode import Opcode
from mcap.records import Channel, ChunkIndex, Schema, Statistics

MAGIC = b"\x89MCAP0\r\n"
FOOTER_BYTES = 1 + 8 + 8 + 8 + 4
HEAD = struct.Struct("<BQ")
"""Opcode and length, at the start of every record."""
MESSAGE = struct.Struct("<HIQQ")
"""Channel, sequence number, times of reception and sending (ns); the data follows."""
CHUNK = struct.Struct("<QQQII")
"""First and last time (ns), size, CRC, and the length of the compression's name."""


class Place(NamedTuple):
    """The place of a record in a file: where its content begins, and its length (bytes)."""

    opcode: int
    begin: int
    length: int

    def content(self, file: BinaryIO) -> bytes:
        """Read the content of the record."""
        file.seek(self.begin)
        return file.read(self.length)


class StoredMessage(NamedTuple):
    """A serialized message as stored in the file; times are in ns since the epoch."""

    channel: int
    received: int
    data: bytes
    sent: int = 0
    sequence: int = 0


def places(file: BinaryIO, begin: int, end: int) -> Iterator[Place]:
    """The records between two positions; raises `EOFError` if one extends beyond `end`."""
    while begin < end:
        file.seek(begin)
        head = file.read(HEAD.size)
        opcode, length = HEAD.unpack(head) if len(head) == HEAD.size else (0, end)
        begin += HEAD.size
        if length > end - begin:
            raise EOFError("a record is longer than the file")
        yield Place(opcode, begin, length)
        begin += length


def chunk_records(content: bytes) -> Iterator[tuple[int, bytes]]:
    """The opcode and content of each record in a chunk; raises `ValueError` if the chunk cannot be unpacked."""
    _, _, size, _, name = CHUNK.unpack_from(content)
    begin = CHUNK.size + name
    compression = content[CHUNK.size : begin].decode()
    (length,) = struct.unpack_from("<Q", content, begin)
    data = unpack_chunk(content[begin + 8 : begin + 8 + length], compression, size)
    at = 0
    while at < len(data):
        opcode, length = HEAD.unpack_from(data, at)
        at += HEAD.size
        if length > len(data) - at:
            raise EOFError("a record is longer than its chunk")
        yield opcode, data[at : at + length]
        at += length


def message(content: bytes) -> StoredMessage:
    """Parse a message record."""
    channel, sequence, received, sent = MESSAGE.unpack_from(content)
    return StoredMessage(channel, received, content[MESSAGE.size :], sent, sequence)


class Tables:
    """Collects the schemas, channels, statistics and chunk indexes of a file from its records."""

    def __init__(self) -> None:
        self.schemas: dict[int, Schema] = {}
        self.channels: dict[int, Channel] = {}
        self.statistics: Statistics | None = None
        self.chunks: list[ChunkIndex] = []

    def add(self, opcode: int, content: bytes) -> None:
        """Add a record; other kinds of records are ignored."""
        stream = ReadDataStream(BytesIO(content))
        if opcode == Opcode.SCHEMA:
            schema = Schema.read(stream)
            self.schemas[schema.id] = schema
        elif opcode == Opcode.CHANNEL:
            channel = Channel.read(stream)
            self.channels[channel.id] = channel
        elif opcode == Opcode.STATISTICS:
            self.statistics = Statistics.read(stream)
        elif opcode == Opcode.CHUNK_INDEX:
            self.chunks.append(ChunkIndex.read(stream))

    @property
    def complete(self) -> bool:
        """Whether these tables cover all messages, so that the file need not be scanned."""
        figures = self.statistics
        if figures is None or figures.chunk_count != len(self.chunks) or (figures.message_count and not self.chunks):
            return False
        known = figures.channel_message_counts.keys() <= self.channels.keys()
        return known and all(each.schema_id in (0, *self.schemas) for each in self.channels.values())
