"""Writes the files of a bag: MCAP or SQLite, in the format of rosbag2's storage plug-ins."""

from __future__ import annotations

import os
import sqlite3
from pathlib import Path
from typing import Any, Protocol

from bot_console.tui.console.bags.metadata import Topic, metadata_yaml

SCHEMA = """
create table schema (schema_version integer primary key, ros_distro text not null);
create table metadata (id integer primary key, metadata_version integer not null, metadata text not null);
create table topics (id integer primary key, name text not null, type text not null, serialization_format text not null,
    offered_qos_profiles text not null, type_description_hash text not null);
create table message_definitions (id integer primary key, topic_type text not null, encoding text not null,
    encoded_message_definition text not null, type_description_hash text not null);
create table messages (id integer primary key, topic_id integer not null, timestamp integer not null,
    data blob not null);
create index timestamp_idx on messages (timestamp asc);
insert into schema values (4, 'jazzy');
"""
"""Schema version 4, which Jazzy writes."""


def encoding_of(definition: str) -> str:
    """The encoding of a message definition; empty without a definition, as in rosbag2 and MCAP."""
    return "ros2msg" if definition else ""


class Storage(Protocol):
    """A bag file being written; every method may raise `OSError`."""

    def topic(self, topic: Topic, definition: str) -> None:
        """Add a topic, with the definition of its type in the encoding `ros2msg`, or an empty one."""
        ...

    def write(self, topic: str, data: bytes, received: int, sent: int) -> None:
        """Add a message, with the times (ns since the epoch) at which it was received and sent."""
        ...

    def flush(self) -> None:
        """Pass buffered data to the operating system."""
        ...

    def close(self) -> None:
        """Finish the file."""
        ...


class McapStorage:
    """An MCAP file; a program that is killed leaves it readable up to the last flush."""

    def __init__(self, path: Path, *, compressed: bool, crc: bool) -> None:
        from mcap.writer import CompressionType, Writer

        self._file = path.open("xb")
        compression = CompressionType.ZSTD if compressed else CompressionType.NONE
        self._writer = Writer(self._file, compression=compression, enable_crcs=crc)
        self._writer.start(profile="ros2", library="bot-console")
        self._channels: dict[str, int] = {}
        self._schemas: dict[str, int] = {}
        self._numbers: dict[int, int] = {}

    def topic(self, topic: Topic, definition: str) -> None:
        """Add a topic."""
        if topic.type not in self._schemas:
            encoding = encoding_of(definition)
            self._schemas[topic.type] = self._writer.register_schema(topic.type, encoding, definition.encode())
        facts = {"offered_qos_profiles": metadata_yaml(topic.qos), "topic_type_hash": topic.type_hash}
        self._channels[topic.name] = self._writer.register_channel(
            topic=topic.name, message_encoding=topic.encoding, schema_id=self._schemas[topic.type], metadata=facts
        )

    def write(self, topic: str, data: bytes, received: int, sent: int) -> None:
        """Add a message."""
        channel = self._channels[topic]
        number = self._numbers[channel] = self._numbers.get(channel, -1) + 1
        self._writer.add_message(channel, log_time=received, data=data, publish_time=sent or received, sequence=number)

    def flush(self) -> None:
        """Pass buffered data to the operating system."""
        self._writer.flush()

    def close(self) -> None:
        """Finish the file."""
        self._writer.finish()
        self._file.flush()
        os.fsync(self._file.fileno())
        self._file.close()


class SqliteStorage:
    """An SQLite file; if the program is killed, it contains what was flushed."""

    def __init__(self, path: Path) -> None:
        path.open("xb").close()
        self._base = sqlite3.connect(path, check_same_thread=False)
        self._base.executescript(SCHEMA)
        self._topics: dict[str, int] = {}
        self._types: set[str] = set()

    def topic(self, topic: Topic, definition: str) -> None:
        """Add a topic."""
        id = self._topics[topic.name] = len(self._topics) + 1
        qos = metadata_yaml(topic.qos)
        self._do("insert into topics values (?, ?, ?, ?, ?, ?)", id, topic.name, topic.type, topic.encoding, qos,
                 topic.type_hash)  # fmt: skip
        if topic.type not in self._types:
            self._types.add(topic.type)
            asked = (
                "insert into message_definitions (topic_type, encoding, encoded_message_definition, "
                "type_description_hash) values (?, ?, ?, ?)"
            )
            self._do(asked, topic.type, encoding_of(definition), definition, topic.type_hash)

    def write(self, topic: str, data: bytes, received: int, sent: int) -> None:
        """Add a message; the format has no time of sending."""
        asked = "insert into messages (topic_id, timestamp, data) values (?, ?, ?)"
        self._do(asked, self._topics[topic], received, data)

    def flush(self) -> None:
        """Commit the messages written so far."""
        try:
            self._base.commit()
        except sqlite3.Error as error:
            raise OSError(str(error)) from error

    def close(self) -> None:
        """Finish the file."""
        self.flush()
        self._base.close()

    def _do(self, asked: str, *values: Any) -> None:
        try:
            self._base.execute(asked, values)
        except sqlite3.Error as error:
            raise OSError(str(error)) from error
