"""Decompresses parts of bags: MCAP chunks, single messages, and whole files. The unpacked size is limited."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

ZSTD = b"\x28\xb5\x2f\xfd"
"""How a zstd frame begins; serialized messages begin with a zero."""
MAX_PART_BYTES = 256 * 1024**2
"""Maximum unpacked size of a chunk or a message."""
MAX_RATIO = 200
"""Maximum ratio of a file's unpacked size to its packed size, beyond `FREE_BYTES`."""
FREE_BYTES = 1024**3
"""A file may unpack to this size whatever the ratio."""
FRAME_HEADER_BYTES = 18
"""Maximum size of a zstd frame header."""
PIECE_BYTES = 1024**2
"""Bytes unpacked at a time."""


class TooLarge(ValueError):
    """Compressed data unpacks to more than a bag plausibly contains."""

    def __init__(self, what: str, maximum: int) -> None:
        super().__init__(f"{what} unpacks to more than {maximum / 1024**2:.0f} MiB, and was not unpacked")


def unpack_message(data: bytes) -> bytes:
    """Return a message as it was before rosbag2 compressed it, or unchanged if it is not compressed."""
    if not data.startswith(ZSTD):
        return data
    from zstandard import CONTENTSIZE_UNKNOWN, get_frame_parameters

    size = get_frame_parameters(data).content_size
    message = _unzstd(data, MAX_PART_BYTES if size == CONTENTSIZE_UNKNOWN else size, "a message")
    if len(message) < size != CONTENTSIZE_UNKNOWN:
        raise EOFError(f"a message ends after {len(message)} of {size} bytes")
    return message


def unpack_chunk(data: bytes, compression: str, size: int) -> bytes:
    """Decompress the records of a chunk; raises `ValueError` if they do not have the given size (bytes)."""
    if compression == "zstd":
        data = _unzstd(data, size, "a chunk")
    elif compression == "lz4":
        data = _unlz4(data, size)
    elif compression:
        raise ValueError(f"a chunk is compressed with {compression}, which is not known here")
    if len(data) != size:
        raise ValueError(f"a chunk has {len(data)} bytes instead of {size}")
    return data


def unpack_file(path: Path, into: Path) -> Path:
    """Decompress a file that rosbag2 compressed as a whole, and return its path in the folder `into`.

    Raises `ValueError` if it is too large, `EOFError` if it is cut off, `ZstdError`, and `OSError`.
    """
    from zstandard import CONTENTSIZE_UNKNOWN, ZstdDecompressor, get_frame_parameters

    maximum = max(FREE_BYTES, path.stat().st_size * MAX_RATIO)
    room = shutil.disk_usage(into).free // 2
    target, size = into / path.stem, 0
    with path.open("rb") as file, target.open("wb") as unpacked:
        declared = get_frame_parameters(file.read(FRAME_HEADER_BYTES)).content_size
        file.seek(0)
        reader = ZstdDecompressor().stream_reader(file, read_across_frames=True)
        while piece := reader.read(PIECE_BYTES):
            size += len(piece)
            if size > maximum:
                raise TooLarge("it", maximum)
            if size > room:
                raise ValueError(
                    f"it needs more than half of what is free in {into.parent}, {room >> 20} MiB, unpacked"
                )
            unpacked.write(piece)
    if declared != CONTENTSIZE_UNKNOWN and size < declared:
        raise EOFError(f"it ends after {size} of {declared} bytes")
    return target


def _unzstd(data: bytes, size: int, what: str) -> bytes:
    from zstandard import ZstdDecompressor, ZstdError

    if size > MAX_PART_BYTES:
        raise TooLarge(what, MAX_PART_BYTES)
    reader, pieces, left = ZstdDecompressor().stream_reader(data), list[bytes](), size + 1
    try:
        while left and (piece := reader.read(min(left, PIECE_BYTES))):
            pieces.append(piece)
            left -= len(piece)
    except ZstdError as error:
        raise ValueError(f"{what} cannot be unpacked: {error}") from None
    if not left:
        raise (
            TooLarge(what, size) if size == MAX_PART_BYTES else ValueError(f"{what} unpacks to more than {size} bytes")
        )
    return b"".join(pieces)


def _unlz4(data: bytes, size: int) -> bytes:
    import lz4.frame  # pyright: ignore[reportMissingTypeStubs] # it has none

    if size > MAX_PART_BYTES:
        raise TooLarge("a chunk", MAX_PART_BYTES)
    decompressor: Any = lz4.frame.LZ4FrameDecompressor()
    try:
        return decompressor.decompress(data, max_length=size + 1)
    except RuntimeError as error:
        raise ValueError(f"a chunk cannot be unpacked: {error}") from None
