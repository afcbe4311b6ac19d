"""Text for the clipboard of the terminal (OSC 52), which works over SSH. Pure."""

from __future__ import annotations

import base64

MAX_BYTES = 32_768
"""Bytes of text: terminals drop larger ones whole, some from 74,994 letters of base64 on; a slow line is held up."""


def osc52(text: str) -> str:
    """The OSC 52 sequence that copies a text to the clipboard; base64 keeps the text from acting on the terminal."""
    return f"\x1b]52;c;{base64.b64encode(text.encode('utf-8', 'replace')).decode()}\x07"


def within(text: str) -> str:
    """Truncate a text to what is sent to a clipboard, without splitting the last letter."""
    return text.encode("utf-8", "replace")[:MAX_BYTES].decode("utf-8", "ignore")
