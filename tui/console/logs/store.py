"""Stores log records in columns: numpy arrays for what is filtered by number, blobs of UTF-8 for the texts.

A record takes about 75 bytes and hardly any work of the garbage collector, whereas with a list of a million record
objects each full collection would stop every thread for 0.2 s. Readers take no lock: a segment is only ever appended
to, and its `count` is written last.
"""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable
from types import MappingProxyType
from typing import Generic, TypeAlias, TypeVar

import numpy as np
from bot_console.tui.console.logs.repeat_folding import repeat_key
from bot_console.tui.console.model import LogRecord, LogState, Severity

T = TypeVar("T")
Site: TypeAlias = "tuple[str, str, int]"
"""File, function, line."""
SEGMENT_RECORDS = 16_384
CAPACITY = 63 * SEGMENT_RECORDS
"""The number of records kept: a million, in addition to the segment being filled."""
MAX_RECENT_ERRORS = 1000
"""The number of errors that can still be discounted, see `LogStore.discount_errors`."""


class LogSegment:
    """Up to `size` records in columns, with their texts concatenated, each followed by a newline."""

    def __init__(self, first: int, size: int) -> None:
        self.first = first
        self.count = 0
        self.size = size
        self.stamp = np.zeros(size, np.int64)
        self.severity = np.zeros(size, np.uint8)
        self.node = np.zeros(size, np.uint32)
        self.site = np.zeros(size, np.uint32)
        self.key = np.zeros(size, np.int64)
        """The `repeat_key` of each record."""
        self.start = np.zeros(size + 1, np.int64)
        self._blob: bytes | bytearray = bytearray()

    def append(self, stamp: int, severity: int, node: int, site: int, raw: bytes) -> None:
        """Add a record. There must be only one writer at a time."""
        index = self.count
        self.stamp[index] = stamp
        self.severity[index] = severity
        self.node[index] = node
        self.site[index] = site
        self.key[index] = repeat_key(node, severity, raw)
        self._blob += raw
        self._blob += b"\n"
        self.start[index + 1] = len(self._blob)
        self.count = index + 1
        if self.count == self.size:
            self._blob = bytes(self._blob)

    def texts(self, begin: int, end: int) -> bytes:
        """The texts of some records, each followed by a newline."""
        blob = self._blob
        left, right = int(self.start[begin]), int(self.start[end])
        return blob if left == 0 and right == len(blob) and isinstance(blob, bytes) else bytes(blob[left:right])

    def text(self, index: int) -> str:
        """The text of the record at this index."""
        return self._blob[int(self.start[index]) : int(self.start[index + 1]) - 1].decode("utf-8", "replace")


class Table(Generic[T]):
    """Assigns numbers to values that occur repeatedly."""

    def __init__(self) -> None:
        self.items: list[T] = []
        self._ids: dict[T, int] = {}

    def id(self, item: T) -> int:
        """The number of an item, assigned at its first use."""
        number = self._ids.get(item)
        if number is None:
            number = self._ids[item] = len(self.items)
            self.items.append(item)
        return number


class LogStore:
    """A ring of log records numbered from 0. Any thread may add records; readers neither wait nor block a writer."""

    def __init__(self, capacity: int = CAPACITY) -> None:
        self._size = max(1, min(SEGMENT_RECORDS, capacity // 2))
        self._maximum = max(2, capacity // self._size)
        self.segments: tuple[LogSegment, ...] = (LogSegment(0, self._size),)
        self.names: Table[str] = Table()
        self.sites: Table[Site] = Table()
        self._lock = threading.Lock()
        self._counts = dict.fromkeys(Severity, 0)
        self._recent_errors: deque[tuple[int, Severity, str]] = deque(maxlen=MAX_RECENT_ERRORS)
        """The counted errors: when they arrived (ns since the epoch), their severities and loggers."""
        self._dropped = 0
        self._state = LogState()

    @property
    def state(self) -> LogState:
        """Which records are kept; the same object until a record is added or the log is cleared."""
        segments = self.segments
        first, end = segments[0].first, segments[-1].first + segments[-1].count
        if (self._state.first, self._state.end) != (first, end):
            counts = MappingProxyType({key: count for key, count in self._counts.items() if count})
            self._state = LogState(first, end, self._dropped, counts)
        return self._state

    def add(self, stamp: int, severity: int, node: str, text: str, site: Site = ("", "", 0)) -> None:
        """Append one record; `site` is file, function, line."""
        raw = text.encode("utf-8", "replace")
        level = _nearest(severity)
        with self._lock:
            segment = self.segments[-1]
            if segment.count == segment.size:
                segment = self._roll()
            self._counts[level] += 1
            if level >= Severity.ERROR:
                self._recent_errors.append((time.time_ns(), level, node))
            segment.append(stamp, level, self.names.id(node), self.sites.id(site), raw)

    def discount_errors(self, expected: Callable[[int, str], bool]) -> None:
        """No longer count recent errors that were `expected`, given the time of arrival (ns) and the logger of each."""
        with self._lock:
            kept = [each for each in self._recent_errors if not expected(each[0], each[2])]
            if len(kept) == len(self._recent_errors):
                return
            for _, level, _ in self._recent_errors:
                self._counts[level] -= 1
            for _, level, _ in kept:
                self._counts[level] += 1
            self._recent_errors = deque(kept, MAX_RECENT_ERRORS)
            self._state = LogState(-1)  # replaced when the state is next requested

    def _roll(self) -> LogSegment:
        kept = self.segments
        if len(kept) == self._maximum:
            self._dropped += kept[0].count
            kept = kept[1:]
        new = LogSegment(self.segments[-1].first + self.segments[-1].count, self._size)
        self.segments = (*kept, new)
        return new

    def record(self, seq: int) -> LogRecord | None:
        """The record with that number; None if it is not kept."""
        segments = self.segments
        place = (seq - segments[0].first) // self._size
        if seq < segments[0].first or place >= len(segments):
            return None
        segment = segments[place]
        index = seq - segment.first
        if index >= segment.count:
            return None
        file, function, line = self.sites.items[int(segment.site[index])]
        severity = Severity(int(segment.severity[index]))
        node = self.names.items[int(segment.node[index])]
        return LogRecord(seq, int(segment.stamp[index]), severity, node, segment.text(index), file, function, line)

    def clear(self) -> None:
        """Discard all records; numbering continues."""
        with self._lock:
            last = self.segments[-1]
            self.segments = (LogSegment(last.first + last.count, self._size),)
            self._counts = dict.fromkeys(Severity, 0)
            self._recent_errors.clear()
            self._dropped = 0


def _nearest(severity: int) -> Severity:
    """The named severity at or below a number; `rcl_interfaces/msg/Log` allows other numbers."""
    return max((level for level in Severity if level <= severity), default=Severity.UNSET)
