"""The header of serialized messages, and the error for invalid bytes."""

from __future__ import annotations

HEADER_SIZE = 4
ORDERS = {0: ">", 1: "<"}
"""Byte order by the second byte of the header."""


class CdrError(ValueError):
    """The bytes are not a message of the requested class."""
