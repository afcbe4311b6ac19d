"""Refuses command lines with bytes that are not UTF-8, except in paths: names and values of ROS are UTF-8."""

from __future__ import annotations

import os
from collections.abc import Sequence

from bot_console.tui.text.encodable import encodable

WRITTEN = ("--output-dir", "--destination-directory", "--report", "--output", "-o")
"""Options followed by a path that need not exist."""


def encoding_problem(words: Sequence[str]) -> str:
    """A message about the first word that is neither UTF-8 nor a path; empty if there is none."""
    for before, word in zip(["", *words], words, strict=False):
        path = word.rpartition("=")[2]  # also finds the path in `params_file:=PATH`
        if encodable(word) != word and not (os.path.lexists(path) or before in WRITTEN):
            return f"{encodable(word)}: not UTF-8, as names and values of ROS must be, and no file has this name"
    return ""
