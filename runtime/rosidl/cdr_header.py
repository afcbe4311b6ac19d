"""The header of a serialized message, and the error for invalid bytes; separate, so that it needs no generator."""

HEADER_SIZE = 4
"""In bytes."""
ORDERS = {0: ">", 1: "<"}
"""Byte order by the second byte of the header."""


class CdrError(ValueError):
    """The bytes are not a message of the requested class."""
