"""Recorded commands of real ROS 2, and the normalisation with which two recordings are compared."""

from __future__ import annotations

import json
import os
import re
import sys
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import Any

ORACLE = Path(os.environ.get("BOT_CONSOLE_ORACLE", ""), "cli")
COURSE = Path(os.environ.get("BOT_CONSOLE_COURSE", "")).absolute()

Row = dict[str, Any]


@cache
def rows() -> list[Row]:
    """All recorded commands, file by file; empty if there are no recordings."""
    if not (os.environ.get("BOT_CONSOLE_ORACLE") and os.environ.get("BOT_CONSOLE_COURSE")):
        return []
    return [row for file in sorted(ORACLE.glob("*.json")) for row in json.loads(file.read_text("utf-8"))]


def filled(words: Sequence[str], folder: Path) -> list[str]:
    """A recorded command with the folders of this run filled in."""
    return [word.replace("{dir}", str(folder)).replace("{course}", str(COURSE)) for word in words]


USERS_FRAME = re.compile(r'  File "(?:<course>/.*|<string>)", line')
MARKS = re.compile(r"    [ ]*[~^]+[~^ ]*\n")


def normal(text: str, folder: Path) -> str:
    """Output without parts that vary from run to run, and without traceback frames in libraries."""
    text = re.sub(r"\[\d{10}\.\d{9}\]", "[<time>]", text)
    text = text.replace(str(COURSE), "<course>").replace(str(folder), "<dir>")
    text = re.sub(r"File \"(nodes/)", r'File "<course>/\1', text)
    text = re.sub(r"(_ros2cli_(?:daemon_)?)\d+(?:_[0-9a-f]+)?", r"\1<id>", text)
    text = re.sub(r"'[^' ]*/share/", "'<prefix>/share/", text)
    text = re.sub(r"searching: \[.*?\]", "searching: [<prefixes>]", text)
    text = re.sub(r"(min: |max: |std dev: )[\d.]+s", r"\1<n>s", text)
    text = re.sub(r"window: \d+", "window: <n>", text)
    # The number of reports before the command is stopped depends on how long the interpreter took to start.
    text = re.sub(r"average rate: (?:9\.[5-9]|10\.[0-4])\d*", "average rate: ~10", text)
    text = re.sub(r"(average rate: ~10\n.*\n)\1+", r"\1", text)
    return without_library_frames(text)


def without_library_frames(text: str) -> str:
    """Tracebacks reduced to the frames in the course's files, without the additions of newer interpreters.

    Newer interpreters mark the position, show all lines of a statement, and print the text of a `-c`.
    """
    kept: list[str] = []
    inside = False
    lines_left = 0
    for line in text.splitlines(keepends=True):
        if inside and line.startswith("  "):
            if line.startswith("  File "):
                shown = 1 if '"<string>"' in line else 2
                lines_left = shown if USERS_FRAME.match(line) else 0
            if lines_left and not MARKS.fullmatch(line):
                kept.append(line)
                lines_left -= 1
            continue
        inside, lines_left = line == "Traceback (most recent call last):\n", 0
        kept.append(line)
    return "".join(kept)


def usage_of_other_interpreter(row: Row) -> bool:
    """Whether a row is argparse's own text, whose format depends on the Python version."""
    text = row["stdout"] + row["stderr"]
    return text.startswith("usage: ") and sys.version_info[:2] != (3, 11)
