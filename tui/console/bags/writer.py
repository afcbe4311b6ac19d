"""Writes a bag; however the program ends, at most the last second is lost."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from bot_console.tui.console.bags.definitions import definition, interface_type_name
from bot_console.tui.console.bags.metadata import FilePart, Metadata, Topic
from bot_console.tui.console.bags.missing_packages import check
from bot_console.tui.console.bags.storages import McapStorage, SqliteStorage, Storage
from bot_console.tui.files.save_file import NotSaved

FLUSH_S = 0.5
"""The longest time (s) that data is buffered before it is written."""
OVERHEAD_BYTES = 40
"""Approximate size of a message in a file, beyond its data."""


@dataclass(frozen=True)
class WritingOptions:
    """The options for writing a bag."""

    storage: str = "mcap"
    """`mcap` or `sqlite3`."""
    preset: str = "none"
    """Preset for MCAP as in rosbag2: `zstd_fast` and `zstd_small` compress chunks, `fastwrite` leaves out checksums."""
    compression: str = "none"
    """`none`, or `message` or `file` for compression with zstd."""
    max_bytes: int = 0
    """Size (bytes) at which the next file is started; 0: one file."""
    max_seconds: float = 0.0
    """Seconds of messages after which the next file is started; 0: one file."""
    custom: Mapping[str, str] = field(default_factory=dict[str, str])
    """Custom data for the metadata."""


class BagWriter:
    """A new bag folder. Raises `MissingPackageError`, and `NotSaved` if the folder exists or cannot be created."""

    def __init__(self, folder: Path, how: WritingOptions | None = None) -> None:
        check()
        self.folder = folder
        self.how = how or WritingOptions()
        self.metadata = Metadata([], storage=self.how.storage, custom=dict(self.how.custom))
        self._definitions: dict[str, str] = {}
        self._compress: Any = None
        if self.how.compression != "none":
            from zstandard import ZstdCompressor

            self.metadata.compression = self.how.compression
            self._compress = ZstdCompressor()
        try:
            folder.mkdir(parents=True)
            self._storage = self._next()
        except FileExistsError:
            raise NotSaved(f"{folder} exists already; choose another name") from None
        except OSError as error:
            raise NotSaved(f"{folder}: {error.strerror or error}") from error
        self.flush()  # so that a recorder killed before its first message leaves an empty bag, not a broken file
        self.metadata.save(folder)

    def topic(self, name: str, kind: Any, qos: list[dict[str, Any]], type_hash: str = "") -> None:
        """Add a topic; call it before its first message."""
        if name not in self.metadata.topics:
            self.add(Topic(name, interface_type_name(kind), qos, type_hash), definition(kind))

    def add(self, topic: Topic, definition: str) -> None:
        """Add a topic with the text of its definition."""
        self._storage.topic(topic, definition)
        self.metadata.topics[topic.name] = topic
        self._definitions[topic.name] = definition

    def write(self, topic: str, data: bytes, received: int, sent: int) -> None:
        """Add a message (CDR), with the times (ns since the epoch) at which it was received and sent."""
        part = self.metadata.files[-1]
        if part.count and self._is_full(part, received):
            self.split()
            part = self.metadata.files[-1]
        if self.how.compression == "message":
            data = self._compress.compress(data)
        self._storage.write(topic, data, received, sent)
        self._bytes += len(data) + OVERHEAD_BYTES
        self.metadata.topics[topic].count += 1
        part.count += 1
        part.include(received)
        if time.monotonic() - self._flushed > FLUSH_S:
            self.flush()

    def split(self) -> None:
        """Start the next file."""
        self._finish()
        self._storage = self._next()
        for name, topic in self.metadata.topics.items():
            self._storage.topic(topic, self._definitions[name])
        self.metadata.save(self.folder)

    def flush(self) -> None:
        """Pass buffered data to the operating system."""
        self._flushed = time.monotonic()
        self._storage.flush()

    def close(self) -> None:
        """Finish the file and the folder's metadata."""
        self._finish()
        self.metadata.save(self.folder)

    def _is_full(self, part: FilePart, received: int) -> bool:
        seconds = (received - part.begin) / 1e9
        return 0 < self.how.max_bytes <= self._bytes or 0 < self.how.max_seconds <= seconds

    def _next(self) -> Storage:
        number, how = len(self.metadata.files), self.how
        name = f"{self.folder.name}_{number}.{'db3' if how.storage == 'sqlite3' else 'mcap'}"
        path, self._bytes = self.folder / name, 0
        self.metadata.files.append(FilePart(name))
        if how.storage == "sqlite3":
            return SqliteStorage(path)
        return McapStorage(path, compressed=how.preset.startswith("zstd"), crc=how.preset != "fastwrite")

    def _finish(self) -> None:
        self._storage.close()
        if self.how.compression == "file":
            part = self.metadata.files[-1]
            path = self.folder / part.path
            part.path += ".zstd"
            with path.open("rb") as file, (self.folder / part.path).open("xb") as packed:
                self._compress.copy_stream(file, packed, size=path.stat().st_size)
            path.unlink()
