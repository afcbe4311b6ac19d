"""Parses log files: those saved by this console, and what ROS 2 writes to `~/.ros/log` and to a terminal.

    [WARN] [1700000000.123456789] [robot_navigator]: text          nodes, and the console's own files
    1700000000.1234567 [INFO] [launch]: text                       launch.log

A line that begins otherwise belongs to the record above it.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from bot_console.tui.console.model import Severity

_COLOUR = re.compile(r"\x1b\[[0-9;]*m")
_LEVEL = "|".join(each.name for each in Severity)
_HEADS = (
    re.compile(
        rf"\[\s*(?P<level>{_LEVEL}|WARNING)\s*\] \[(?P<time>\d{{1,10}}(?:\.\d{{1,9}})?)\] \[(?P<node>[^\]]*)\]:? ?"
    ),
    re.compile(rf"(?P<time>\d{{1,10}}\.\d{{1,9}}) \[(?P<level>{_LEVEL}|WARNING)\] \[(?P<node>[^\]]*)\]:? ?"),
)
MAX_LINE_CHARACTERS = 1 << 16
"""Maximum length of a record in characters; the rest becomes another record."""
LATEST_NS = 2**63 - 1
"""The latest time that fits a column of the log, in ns since the epoch."""

Add = Callable[[int, int, str, str], None]
"""Receives stamp (ns), severity, node, text."""


class SavedLines:
    """Parses text into records; the text comes in pieces of whole lines."""

    def __init__(self, add: Add, name: str) -> None:
        """`name` is the node of records before the first line that names one."""
        self._add = add
        self._head: tuple[int, int, str] = (0, Severity.INFO, name)
        self._texts: list[str] = []
        self._length = 0

    def feed(self, text: str) -> None:
        """Parse more lines; the last record stays open for continuation lines."""
        for given in (_COLOUR.sub("", text) if "\x1b" in text else text).removesuffix("\n").split("\n"):
            line = given.removesuffix("\r")
            found = next((match for each in _HEADS if (match := each.match(line))), None)
            if found:
                self.settle()
                level = Severity.WARN if found["level"] == "WARNING" else Severity[found["level"]]
                self._head = (_stamp(found["time"]), level, found["node"])
                line = line[found.end() :]
            elif self._length + len(line) > MAX_LINE_CHARACTERS:
                self.settle()
            self._texts.append(line)
            self._length += len(line)

    def settle(self) -> None:
        """Close the last record."""
        if self._texts:
            self._add(*self._head, "\n".join(self._texts))
            self._texts, self._length = [], 0


def _stamp(seconds: str) -> int:
    whole, _, part = seconds.partition(".")
    return min(int(whole) * 10**9 + int(part.ljust(9, "0")), LATEST_NS)
