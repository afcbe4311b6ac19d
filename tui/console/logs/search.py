"""Which records of a log pass a filter, found for many at a time: never line by line, and without a lock."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

import numpy as np
import numpy.typing as npt
from bot_console.tui.console.logs.patterns import Pattern, Spans
from bot_console.tui.console.logs.store import LogSegment, LogStore
from bot_console.tui.console.model import LogFilter, Severity
from bot_console.tui.console.query import NodeTerm, parse

Mask = npt.NDArray[np.bool_]
Rows = npt.NDArray[np.int64]
SPARSE = 64
"""Hits in one text after which runs of lines are looked for instead of single places."""


class LogSearch:
    """A filter made ready; raises `ValueError` for one that does not parse."""

    def __init__(self, store: LogStore, which: LogFilter) -> None:
        self._names = store.names
        self._query = parse(which.words)
        self._hidden_nodes = which.hidden_nodes
        wanted = self._query.severities - which.hidden_severities
        self._levels = np.zeros(256, np.bool_)
        self._levels[[level for level in Severity if level in wanted and level >= which.minimum]] = True

    def passing(self, segment: LogSegment, begin: int, end: int) -> Rows:
        """Numbers, rising, of the records from index `begin` to before `end` of a segment that pass."""
        mask = self._levels[segment.severity[begin:end]]
        nodes = segment.node[begin:end]
        if self._hidden_nodes:
            mask &= self._by_name(lambda name: name not in self._hidden_nodes)[nodes]
        for term in self._query.nodes:
            mask &= self._standing_in(term)[nodes] != term.exclude
        if self._query.texts and mask.any():
            blob, ends = segment.texts(begin, end), segment.start[begin + 1 : end + 1] - segment.start[begin]
            for term in self._query.texts:
                found = hits(term.pattern, blob, ends)
                if term.name is not None:
                    found |= self._standing_in(term.name)[nodes]
                mask &= found != term.exclude
        return np.flatnonzero(mask) + (begin + segment.first)

    def _standing_in(self, term: NodeTerm) -> Mask:
        return self._by_name(term.stands_in)

    def _by_name(self, test: Callable[[str], bool]) -> Mask:
        return np.array([test(name) for name in self._names.items], np.bool_)


def hits(pattern: Pattern, blob: bytes, ends: Rows) -> Mask:
    """In which of the texts a pattern is found; `ends` says where each text ends in the blob, its newline included."""
    found = np.zeros(len(ends), np.bool_)
    at = 0
    for count, row in enumerate(_rows(pattern.first, blob, ends)):
        found[row] = True
        at = int(ends[row])
        if count == SPARSE and pattern.word is not None:
            places = [match.start() for match in re.finditer(pattern.word, blob[at:].lower())]
            found[np.searchsorted(ends, np.array(places, np.int64) + at, side="right")] = True
            break
        if count == SPARSE and pattern.run is not None:
            _mark_runs(pattern.run, blob, ends, at, found)
            break
    return found


def _rows(first: Spans, blob: bytes, ends: Rows) -> Iterator[int]:
    """The texts with a match, one search for each; a match that runs on into the next text is looked at again."""
    at = 0
    while at < len(blob):
        span = first(blob, at)
        if span is None or span[0] >= len(blob):
            return
        row = int(np.searchsorted(ends, span[0], side="right"))
        begin, end = int(ends[row - 1]) if row else 0, int(ends[row])
        if span[1] < end or first(blob[begin : end - 1], 0) is not None:
            yield row
        at = end


def _mark_runs(run: Spans, blob: bytes, ends: Rows, at: int, found: Mask) -> None:
    """Mark the texts from `at` on that have a matching line; one search for each run of such lines."""
    spans: list[tuple[int, int]] = []
    while at < len(blob) and (span := run(blob, at)) is not None:
        spans.append(span)
        at = span[1]
    if not spans:
        return
    places = np.array(spans, np.int64)
    firsts = np.searchsorted(ends, places[:, 0], side="right")
    lasts = np.searchsorted(ends, places[:, 1] - 1, side="right")
    steps = np.zeros(len(ends) + 1, np.int64)
    np.add.at(steps, firsts, 1)
    np.add.at(steps, lasts + 1, -1)
    found |= np.cumsum(steps[:-1]) > 0


def matching(store: LogStore, which: LogFilter, after: int = 0, limit: int | None = None) -> list[int]:
    """Numbers, rising, of all kept records from `after` on that pass; with a limit the newest ones."""
    search = LogSearch(store, which)
    parts = [
        search.passing(segment, max(0, after - segment.first), segment.count)
        for segment in store.segments
        if segment.first + segment.count > after
    ]
    found = np.concatenate(parts) if parts else np.zeros(0, np.int64)
    return (found if limit is None else found[max(0, len(found) - limit) :]).tolist()
