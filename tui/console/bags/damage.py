"""Handles damaged files: converts reading errors, and repairs a file that a killed program did not finish."""

from __future__ import annotations

import os
import sqlite3
import struct
from collections.abc import Callable, Generator, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

from bot_console.tui.console.bags.compression import TooLarge

MAX_CUT_BYTES = 16 * 1024 * 1024
"""The most that a repair may discard: as much as a recorder writes at once. If more would be lost, the original is kept
as well.
"""
BACKUP_SUFFIX = ".damaged"
"""Suffix of the file name under which the original is kept."""

DAMAGED = (
    ValueError, LookupError, TypeError, OverflowError, MemoryError, EOFError, struct.error, sqlite3.Error,
)  # fmt: skip
"""Exceptions besides `McapError` that the libraries raise when lengths and offsets in a damaged file are wrong."""


class BagError(ValueError):
    """A path that cannot be read as a bag; the message says which path and why."""


@contextmanager
def reading_errors(path: Path, where: Callable[[], str] = str) -> Generator[None]:
    """Convert exceptions raised while reading `path` to `BagError`; their messages say `where` the reader was."""
    from mcap.exceptions import McapError
    from zstandard import ZstdError

    try:
        yield
    except BagError:
        raise
    except OSError as error:
        raise BagError(f"{path}: {error.strerror or error}") from None
    except TooLarge as error:
        raise BagError(f"{path}{where()}: {error}") from None
    except (McapError, ZstdError, *DAMAGED) as error:
        raise BagError(f"{path} is damaged{where()}: {error or type(error).__name__}") from None


def repair(path: Path, shown: Path) -> str:
    """Complete an unfinished file, which messages call `shown`.

    Returns a description of the repair, or an empty text if the file was complete. Raises `BagError`.
    """
    from bot_console.tui.console.bags.mcap_records import MAGIC

    with reading_errors(shown), path.open("rb") as file:
        if file.read(len(MAGIC)) != MAGIC:
            raise BagError(f"{shown}: not an MCAP file")
        size = file.seek(0, os.SEEK_END)
        file.seek(max(len(MAGIC), size - len(MAGIC)))
        if file.read() == MAGIC:
            return ""
        beside = path.with_suffix(".repairing")
        try:
            behind, cut = _copy_readable(file, size, beside)
            lost = size - behind
            done = f"{shown.name} had no end, as a killed recorder leaves it, and was given one"
            if lost > MAX_CUT_BYTES or not cut:
                kept = path.with_name(path.name + BACKUP_SUFFIX)
                path.replace(kept)
                done = f"{shown.name} is damaged {lost} bytes before its end; as it was it is kept as {kept.name}"
            beside.replace(path)
        except OSError as error:
            beside.unlink(missing_ok=True)
            raise BagError(f"{shown} has no end, and cannot be given one: {error.strerror or error}") from None
    return done


def _copy_readable(source: BinaryIO, size: int, beside: Path) -> tuple[int, bool]:
    """Copy the readable records to the file `beside`.

    Returns the position in the source after the last of them, and whether the rest is merely truncated rather than
    damaged.
    """
    from bot_console.tui.console.bags.mcap_records import Tables, message
    from mcap.exceptions import McapError
    from mcap.opcode import Opcode
    from mcap.writer import CompressionType, Writer

    behind, cut = 0, True
    with beside.open("wb") as file:
        writer = Writer(file, compression=CompressionType.NONE)
        writer.start(profile="ros2", library="bot-console")
        tables = Tables()
        channels: dict[int, int] = {}
        schemas: dict[int, int] = {0: 0}
        try:
            for opcode, content, behind in _readable_records(source, size):  # noqa: B007 -- the last one is returned
                tables.add(opcode, content)
                if opcode != Opcode.MESSAGE:
                    continue
                found = message(content)
                if found.channel not in channels:
                    channel = tables.channels[found.channel]
                    schema = tables.schemas.get(channel.schema_id)
                    if schema is not None and schema.id not in schemas:
                        schemas[schema.id] = writer.register_schema(schema.name, schema.encoding, schema.data)
                    channels[found.channel] = writer.register_channel(
                        channel.topic, channel.message_encoding, schemas.get(channel.schema_id, 0), channel.metadata
                    )
                writer.add_message(channels[found.channel], found.received, found.data, found.sent, found.sequence)
        except EOFError:
            pass
        except (McapError, *DAMAGED):
            cut = False
        writer.finish()
        file.flush()
        os.fsync(file.fileno())
    return behind, cut


def _readable_records(source: BinaryIO, size: int) -> Iterator[tuple[int, bytes, int]]:
    """The records of a file and its chunks: opcode, content, and the position in the file after the record or chunk."""
    from bot_console.tui.console.bags.mcap_records import MAGIC, chunk_records, places
    from mcap.opcode import Opcode

    for each in places(source, len(MAGIC), size):
        end = each.begin + each.length
        if each.opcode == Opcode.DATA_END:
            return
        if each.opcode == Opcode.CHUNK:
            for opcode, content in chunk_records(each.content(source)):
                yield opcode, content, end
        elif each.opcode in (Opcode.SCHEMA, Opcode.CHANNEL, Opcode.MESSAGE):
            yield each.opcode, each.content(source), end
