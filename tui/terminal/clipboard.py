"""Text for the clipboard of the terminal (OSC 52), which works over SSH. Pure."""

from __future__ import annotations

import base64

LARGEST = 32_768
"""Bytes of text: terminals drop larger ones whole, some from 74,994 letters of base64 on; a slow line is held up."""


def osc52(text: str) -> str:
    """The sequence that puts a text on the clipboard; in base64, so that nothing in the text acts on the terminal."""
    return f"\x1b]52;c;{base64.b64encode(text.encode('utf-8', 'replace')).decode()}\x07"


def within(text: str) -> str:
    """As much of a text as a clipboard is sent, without half a letter at its end."""
    return text.encode("utf-8", "replace")[:LARGEST].decode("utf-8", "ignore")
