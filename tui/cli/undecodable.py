"""Command lines with bytes that are not UTF-8: names and values of ROS are UTF-8, and only paths may be anything."""

from __future__ import annotations

import os
from collections.abc import Sequence

from bot_console.tui.text.encodable import encodable

WRITTEN = ("--output-dir", "--destination-directory", "--report", "--output", "-o")
"""Options followed by a path that need not exist."""


def undecodable(words: Sequence[str]) -> str:
    """The problem with the first word that is neither UTF-8 nor a path; empty if there is none."""
    for before, word in zip(["", *words], words, strict=False):
        path = word.rpartition("=")[2]  # Also for `params_file:=PATH`.
        if encodable(word) != word and not (os.path.lexists(path) or before in WRITTEN):
            return f"{encodable(word)}: not UTF-8, as names and values of ROS must be, and no file has this name"
    return ""
