"""Writes a bag so that at most the last second is lost, however the program ends."""

from __future__ import annotations

import os
import time
from pathlib import Path
from typing import Any

from bot_console.tui.console.bags.definitions import definition, interface_type_name
from bot_console.tui.console.bags.metadata import FilePart, Metadata, Topic, metadata_yaml
from bot_console.tui.console.bags.missing_packages import check
from bot_console.tui.files.save_file import NotSaved

FLUSH = 0.5
"""Seconds after which buffered data is written at the latest."""


class BagWriter:
    """A new bag folder. Raises `Missing` without `mcap`, and `NotSaved` if the folder exists or cannot be created."""

    def __init__(self, folder: Path) -> None:
        check()
        from mcap.writer import CompressionType, Writer

        self.folder = folder
        self.metadata = Metadata([FilePart(f"{folder.name}_0.mcap")])
        try:
            folder.mkdir(parents=True)
            self._file = (folder / self.metadata.files[0].path).open("xb")
        except FileExistsError:
            raise NotSaved(f"{folder} exists already; choose another name") from None
        except OSError as error:
            raise NotSaved(f"{folder}: {error.strerror or error}") from error
        self._writer = Writer(self._file, compression=CompressionType.NONE)
        self._writer.start(profile="ros2", library="bot-console")
        self._channels: dict[str, int] = {}
        self._schemas: dict[str, int] = {}
        self._numbers: dict[int, int] = {}
        self.flush()  # so that a recorder killed before its first message leaves an empty bag instead of a broken file
        self.metadata.save(folder)

    def topic(self, name: str, kind: Any, qos: list[dict[str, Any]], type_hash: str = "") -> None:
        """Add a topic; call it before its first message."""
        if name in self._channels:
            return
        type = interface_type_name(kind)
        if type not in self._schemas:
            text = definition(kind).encode()
            self._schemas[type] = self._writer.register_schema(name=type, encoding="ros2msg", data=text)
        offered = metadata_yaml(qos)
        facts = {"offered_qos_profiles": offered, "topic_type_hash": type_hash}
        self._channels[name] = self._writer.register_channel(
            topic=name, message_encoding="cdr", schema_id=self._schemas[type], metadata=facts
        )
        self.metadata.topics[name] = Topic(name, type, qos, type_hash)

    def write(self, topic: str, data: bytes, received: int, sent: int) -> None:
        """Add a message (CDR), with the times (ns since the epoch) at which it was received and sent."""
        channel = self._channels[topic]
        number = self._numbers[channel] = self._numbers.get(channel, -1) + 1
        self._writer.add_message(channel, log_time=received, data=data, publish_time=sent or received, sequence=number)
        self.metadata.topics[topic].count += 1
        self.metadata.files[-1].count += 1
        self.metadata.files[-1].seen(received)
        if time.monotonic() - self._flushed > FLUSH:
            self.flush()

    def flush(self) -> None:
        """Pass what is buffered to the operating system."""
        self._flushed = time.monotonic()
        self._writer.flush()

    def close(self) -> None:
        """Finish the file and the folder's metadata."""
        self._writer.finish()
        self._file.flush()
        os.fsync(self._file.fileno())
        self._file.close()
        self.metadata.save(self.folder)
