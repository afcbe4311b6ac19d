"""Damaged files: errors while reading, and the repair of a file that a killed program did not finish."""

from __future__ import annotations

import os
import sqlite3
import struct
from collections.abc import Callable, Generator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

MAGIC = b"\x89MCAP0\r\n"
MAX_CUT_BYTES = 16 * 1024 * 1024
"""The most that a repair may discard: what a recorder writes at once. If more would be lost, the original is kept
too.
"""
BACKUP_SUFFIX = ".damaged"
"""File name suffix of such an original."""

DAMAGED = (
    ValueError, LookupError, TypeError, OverflowError, MemoryError, EOFError, struct.error, sqlite3.Error,
)  # fmt: skip
"""Exceptions besides `McapError` that the libraries raise on a damaged file, whose lengths and offsets are wrong."""


class NoBag(ValueError):
    """A path that cannot be read as a bag; the message says which path and why."""


@contextmanager
def reading_errors(path: Path, where: Callable[[], str] = str) -> Generator[None]:
    """Convert exceptions of the reading library to `NoBag`."""
    from mcap.exceptions import McapError

    try:
        yield
    except NoBag:
        raise
    except OSError as error:
        raise NoBag(f"{path}: {error.strerror or error}") from None
    except (McapError, *DAMAGED) as error:
        raise NoBag(f"{path} is damaged{where()}: {error or type(error).__name__}") from None


def repair(path: Path) -> str:
    """Complete an unfinished file; returns what was done, or an empty text if it was complete. Raises `NoBag`."""
    with reading_errors(path), path.open("rb") as file:
        if file.read(len(MAGIC)) != MAGIC:
            raise NoBag(f"{path}: not an MCAP file")
        size = file.seek(0, os.SEEK_END)
        file.seek(max(len(MAGIC), size - len(MAGIC)))
        if file.read() == MAGIC:
            return ""
        file.seek(0)
        beside = path.with_suffix(".mending")
        try:
            lost = size - _write_whole(file, beside)
            done = f"{path.name} had no end, as a killed recorder leaves it, and was given one"
            if lost > MAX_CUT_BYTES or file.tell() < size:
                kept = path.with_name(path.name + BACKUP_SUFFIX)
                path.replace(kept)
                done = f"{path.name} is damaged {lost} bytes before its end; as it was it is kept as {kept.name}"
            beside.replace(path)
        except OSError as error:
            beside.unlink(missing_ok=True)
            raise NoBag(f"{path} has no end, and cannot be given one: {error.strerror or error}") from None
    return done


def _write_whole(source: Any, beside: Path) -> int:
    """Copy the readable records to another file; returns the position in the source after the last of them."""
    from mcap.exceptions import McapError
    from mcap.records import Channel, Message, Schema
    from mcap.stream_reader import StreamReader
    from mcap.writer import CompressionType, Writer

    records = iter(StreamReader(source).records)
    with beside.open("wb") as file:
        writer = Writer(file, compression=CompressionType.NONE)
        writer.start(profile="ros2", library="bot-console")
        schemas: dict[int, int] = {0: 0}
        channels: dict[int, int] = {}
        behind = 0
        while True:
            try:
                each = next(records)
            except (StopIteration, McapError, *DAMAGED):  # the end of the readable part
                break
            behind = source.tell()
            if isinstance(each, Schema) and each.id not in schemas:
                schemas[each.id] = writer.register_schema(each.name, each.encoding, each.data)
            elif isinstance(each, Channel) and each.id not in channels:
                channels[each.id] = writer.register_channel(
                    each.topic, each.message_encoding, schemas.get(each.schema_id, 0), each.metadata
                )
            elif isinstance(each, Message) and each.channel_id in channels:
                writer.add_message(
                    channels[each.channel_id], each.log_time, each.data, each.publish_time, each.sequence
                )
        writer.finish()
        file.flush()
        os.fsync(file.fileno())
    return behind
