"""Log records in columns: numpy for what is filtered by number, one blob of UTF-8 for the texts.

About 70 bytes a record, and hardly anything for the garbage collector to walk (a list of a million record objects
stops every thread for 0.2 s at each full collection).
"""

from __future__ import annotations

import re
import threading
from collections.abc import Iterator, Sequence
from types import MappingProxyType
from typing import Generic, TypeVar

import numpy as np
import numpy.typing as npt
from bot_console.tui.console.model import LogFilter, LogRecord, LogState, Severity
from bot_console.tui.console.query import Query, Term, parse

T = TypeVar("T")
Mask = npt.NDArray[np.bool_]


class _Segment:
    """Half of the ring: columns of a fixed size, and the texts one after the other, parted by newlines."""

    def __init__(self, first: int, size: int) -> None:
        self.first = first
        self.count = 0
        self.size = size
        self.stamp = np.zeros(size, np.int64)
        self.severity = np.zeros(size, np.uint8)
        self.node = np.zeros(size, np.uint32)
        self.site = np.zeros(size, np.uint32)
        self.start = np.zeros(size + 1, np.int64)
        self.blob = bytearray()

    def text(self, index: int) -> str:
        """The text of the record at this index."""
        return self.blob[int(self.start[index]) : int(self.start[index + 1]) - 1].decode("utf-8", "replace")


class _Table(Generic[T]):
    """Numbers for values that repeat."""

    def __init__(self) -> None:
        self.items: list[T] = []
        self._ids: dict[T, int] = {}

    def id(self, item: T) -> int:
        """The number of an item, given at its first use."""
        number = self._ids.get(item)
        if number is None:
            number = self._ids[item] = len(self.items)
            self.items.append(item)
        return number


class LogStore:
    """A ring of log records numbered from 0; `add` may be called from another thread than the readers'."""

    def __init__(self, capacity: int = 200_000) -> None:
        self._half = max(1, capacity // 2)
        self._segments = [_Segment(0, self._half)]
        self._lock = threading.Lock()
        self._names: _Table[str] = _Table()
        self._sites: _Table[tuple[str, str, int]] = _Table()
        self._counts = dict.fromkeys(Severity, 0)
        self._dropped = 0
        self._state = LogState()

    @property
    def state(self) -> LogState:
        """What is kept; the same object until a record is added or the log cleared."""
        newest = self._segments[-1]
        if self._state.end != newest.first + newest.count or self._state.first != self._segments[0].first:
            with self._lock:
                counts = MappingProxyType({key: count for key, count in self._counts.items() if count})
                end = self._segments[-1].first + self._segments[-1].count
                self._state = LogState(self._segments[0].first, end, self._dropped, counts)
        return self._state

    def add(self, stamp: int, severity: int, node: str, text: str, site: tuple[str, str, int] = ("", "", 0)) -> None:
        """Append one record; `site` is file, function, line."""
        raw = text.encode("utf-8", "replace")
        with self._lock:
            segment = self._segments[-1]
            if segment.count == segment.size:
                segment = self._roll()
            index = segment.count
            level = _nearest(severity)
            segment.stamp[index] = stamp
            segment.severity[index] = level
            segment.node[index] = self._names.id(node)
            segment.site[index] = self._sites.id(site)
            segment.blob += raw
            segment.blob += b"\n"
            segment.start[index + 1] = len(segment.blob)
            self._counts[level] += 1
            segment.count = index + 1

    def _roll(self) -> _Segment:
        if len(self._segments) == 2:
            oldest = self._segments.pop(0)
            self._dropped += oldest.count
        last = self._segments[-1]
        self._segments.append(_Segment(last.first + last.count, self._half))
        return self._segments[-1]

    def record(self, seq: int) -> LogRecord | None:
        """The record of that number, or None when it is not kept."""
        with self._lock:
            for segment in self._segments:
                index = seq - segment.first
                if 0 <= index < segment.count:
                    file, function, line = self._sites.items[int(segment.site[index])]
                    return LogRecord(
                        seq,
                        int(segment.stamp[index]),
                        Severity(int(segment.severity[index])),
                        self._names.items[int(segment.node[index])],
                        segment.text(index),
                        file,
                        function,
                        line,
                    )
        return None

    def clear(self) -> None:
        """Forget all records; numbers go on."""
        with self._lock:
            last = self._segments[-1]
            self._segments = [_Segment(last.first + last.count, self._half)]
            self._counts = dict.fromkeys(Severity, 0)
            self._dropped = 0

    def matching(self, which: LogFilter, after: int = 0, limit: int | None = None) -> Sequence[int]:
        """Numbers of kept records from `after` on that pass; raises `ValueError` for a filter that does not parse."""
        query = parse(which.words)
        with self._lock:
            parts = [segment.first + self._passing(segment, which, query, after) for segment in self._segments]
        found = np.concatenate(parts) if parts else np.zeros(0, np.int64)
        chosen = found if limit is None else found[max(0, len(found) - limit) :]
        return chosen.tolist()

    def _passing(self, segment: _Segment, which: LogFilter, query: Query, after: int) -> npt.NDArray[np.int64]:
        begin = min(max(0, after - segment.first), segment.count)
        level = segment.severity[begin : segment.count]
        mask: Mask = (level >= max(which.minimum, query.lowest)) & (level <= query.highest)
        for hidden in which.hidden_severities:
            mask &= level != hidden
        nodes = segment.node[begin : segment.count]
        if which.hidden_nodes:
            shown = np.array([name not in which.hidden_nodes for name in self._names.items], np.bool_)
            mask &= shown[nodes]
        for term in query.terms:
            if not mask.any():
                break
            mask &= self._found(segment, begin, nodes, term) != term.exclude
        return np.flatnonzero(mask) + begin

    def _found(self, segment: _Segment, begin: int, nodes: npt.NDArray[np.uint32], term: Term) -> Mask:
        named = np.array([bool(term.pattern.search(name)) for name in self._names.items], np.bool_)[nodes]
        if term.field == "node":
            return named
        found = named if term.field == "" else np.zeros(len(nodes), np.bool_)
        ends = segment.start[begin + 1 : segment.count + 1]
        if len(ends):
            places = list(_places(term.pattern, segment.blob, int(segment.start[begin])))
            rows = np.searchsorted(ends, np.array(places, np.int64), side="right")
            found[rows[rows < len(found)]] = True
        return found


def _places(pattern: re.Pattern[str], blob: bytearray, start: int) -> Iterator[int]:
    """Where a pattern is found in the blob from `start` on. A match cannot cross a newline unless it names one."""
    if pattern.pattern.isascii():
        for match in re.compile(pattern.pattern.encode(), re.IGNORECASE | re.MULTILINE).finditer(blob, start):
            yield match.start()
        return
    text = blob[start:].decode("utf-8", "replace")
    for match in pattern.finditer(text):
        yield start + len(text[: match.start()].encode())


def _nearest(severity: int) -> Severity:
    """The named severity at or below a number; other numbers are allowed in `rcl_interfaces/msg/Log`."""
    return max((level for level in Severity if level <= severity), default=Severity.UNSET)
