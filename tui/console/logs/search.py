"""Searches a log for records that match a filter: many records at a time, and without a lock."""

from __future__ import annotations

from collections.abc import Callable
from typing import Generic, TypeVar

import numpy as np
import numpy.typing as npt
from bot_console.tui.console.filter_syntax import parse
from bot_console.tui.console.logs.hits import hits
from bot_console.tui.console.logs.store import LogSegment, LogStore, Table
from bot_console.tui.console.logs.time_filter import DAY_NS, SECOND_NS, Span, utc_offset
from bot_console.tui.console.model import LogFilter, Severity

Mask = npt.NDArray[np.bool_]
Rows = npt.NDArray[np.int64]
OFFSET_LASTS = 900 * SECOND_NS
"""The offset of local time from UTC only changes at full quarters of an hour (in UTC)."""

T = TypeVar("T")


class LogSearch:
    """A prepared filter; raises `ValueError` if it does not parse."""

    def __init__(self, store: LogStore, which: LogFilter) -> None:
        self._words = _WordMatcher(store, which.words, which.minimum)
        self._hidden = [_WordMatcher(store, each) for each in which.hidden]
        self._only = [_WordMatcher(store, each) for each in which.only]

    def passing(self, segment: LogSegment, begin: int, end: int) -> Rows:
        """The ascending numbers of the matching records, among those with indices `begin` to `end` - 1 in a segment."""
        mask = self._words.matches(segment, begin, end)
        for each in self._hidden:
            if not mask.any():
                break
            mask &= ~each.matches(segment, begin, end)
        if self._only and mask.any():
            wanted = np.zeros(end - begin, np.bool_)
            for each in self._only:
                wanted |= each.matches(segment, begin, end)
            mask &= wanted
        return np.flatnonzero(mask) + (begin + segment.first)


class _WordMatcher:
    """The words of one filter, prepared for searching a store, and a minimum severity."""

    def __init__(self, store: LogStore, words: str, minimum: Severity = Severity.UNSET) -> None:
        query = parse(words)
        levels = [level for level in Severity if level in query.severities and level >= minimum]
        self._levels = np.zeros(256, np.bool_)
        self._levels[levels] = True
        self._least = levels[0] if levels and levels == [each for each in Severity if each >= levels[0]] else None
        """The severity from which on all pass, if the filter is that simple: comparing is cheaper than a table."""
        self._nodes = [(_TestResults(store.names, each.stands_in), each.exclude) for each in query.nodes]
        self._places = [
            (_TestResults(store.sites, lambda site, term=each: term.stands_in(*site)), each.exclude)
            for each in query.places
        ]
        self._spans = query.spans
        self._texts = [
            (each, _TestResults(store.names, each.name.stands_in) if each.name else None) for each in query.texts
        ]

    def matches(self, segment: LogSegment, begin: int, end: int) -> Mask:
        """Whether each of the records with indices `begin` to `end` - 1 in a segment matches."""
        severity = segment.severity[begin:end]
        mask = self._levels[severity] if self._least is None else severity >= self._least
        nodes = segment.node[begin:end]
        for result, exclude in self._nodes:
            mask &= result.of(nodes) != exclude
        for result, exclude in self._places:
            mask &= result.of(segment.site[begin:end]) != exclude
        for term in self._spans:
            mask &= _in_span(term.span, segment.stamp[begin:end]) != term.exclude
        if self._texts and mask.any():
            blob, ends = segment.texts(begin, end), segment.start[begin + 1 : end + 1] - segment.start[begin]
            for term, named in self._texts:
                found = hits(term.pattern, blob, ends)
                if named is not None:
                    found |= named.of(nodes)
                mask &= found != term.exclude
        return mask


class _TestResults(Generic[T]):
    """The results of a test for the items of a table, each of which is tested only once."""

    def __init__(self, table: Table[T], test: Callable[[T], bool]) -> None:
        self._table = table
        self._test = test
        self._known = np.zeros(0, np.bool_)

    def of(self, numbers: npt.NDArray[np.uint32]) -> Mask:
        """The results for items, given their numbers."""
        new = self._table.items[len(self._known) :]
        if new:
            self._known = np.append(self._known, np.array([self._test(each) for each in new], np.bool_))
        return self._known[numbers]


def _in_span(span: Span, stamps: Rows) -> Mask:
    at = (stamps + _offsets(stamps)) % DAY_NS if span.daily else stamps
    if span.begin > span.end:
        return (at >= span.begin) | (at < span.end)
    return (at >= span.begin) & (at < span.end)


def _offsets(stamps: Rows) -> Rows | int:
    """The offset of local time from UTC at each time, in ns."""
    quarters = stamps // OFFSET_LASTS
    if not len(quarters) or quarters.min() == quarters.max():
        return utc_offset(int(stamps[0])) if len(stamps) else 0
    different, places = np.unique(quarters, return_inverse=True)
    return np.array([utc_offset(int(each) * OFFSET_LASTS) for each in different], np.int64)[places]


def matching(store: LogStore, which: LogFilter, after: int = 0, limit: int | None = None) -> list[int]:
    """The ascending numbers of all kept records from `after` on that match; with a limit, the newest ones."""
    search = LogSearch(store, which)
    parts = [
        search.passing(segment, max(0, after - segment.first), segment.count)
        for segment in store.segments
        if segment.first + segment.count > after
    ]
    found = np.concatenate(parts) if parts else np.zeros(0, np.int64)
    return (found if limit is None else found[max(0, len(found) - limit) :]).tolist()
