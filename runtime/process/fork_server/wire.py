"""Framing of jobs on a stream socket: a length, the bytes, and the descriptors that belong to them."""

from __future__ import annotations

import os
import socket
import struct
from collections.abc import Sequence

_LENGTH = struct.Struct("!I")
MAX_DESCRIPTORS = 8
"""File descriptors that one message may carry."""


def send(connection: socket.socket, data: bytes, descriptors: Sequence[int]) -> None:
    """Send one frame; raises `OSError` if nobody reads any more."""
    frame = _LENGTH.pack(len(data)) + data
    sent = socket.send_fds(connection, [frame], list(descriptors))
    connection.sendall(frame[sent:])


def receive(connection: socket.socket) -> tuple[bytes, list[int]] | None:
    """Return the next frame; None at the end."""
    head, descriptors, _, _ = socket.recv_fds(connection, _LENGTH.size, MAX_DESCRIPTORS)
    head += _rest(connection, _LENGTH.size - len(head)) if head else b""
    body = _rest(connection, _LENGTH.unpack(head)[0]) if len(head) == _LENGTH.size else None
    if body is None:
        for each in descriptors:
            os.close(each)
        return None
    return body, descriptors


def _rest(connection: socket.socket, size: int) -> bytes:
    parts: list[bytes] = []
    while size > 0 and (part := connection.recv(size)):
        parts.append(part)
        size -= len(part)
    return b"".join(parts)
