"""Which records of a log pass a filter, found for many at a time: never line by line, and without a lock."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt
from bot_console.tui.console.logs.hits import hits
from bot_console.tui.console.logs.store import LogSegment, LogStore
from bot_console.tui.console.model import LogFilter, Severity
from bot_console.tui.console.query import NodeTerm, parse

Mask = npt.NDArray[np.bool_]
Rows = npt.NDArray[np.int64]


class LogSearch:
    """A filter made ready; raises `ValueError` for one that does not parse."""

    def __init__(self, store: LogStore, which: LogFilter) -> None:
        self._names = store.names
        self._query = parse(which.words)
        self._hidden_nodes = which.hidden_nodes
        wanted = self._query.severities - which.hidden_severities
        levels = [level for level in Severity if level in wanted and level >= which.minimum]
        self._levels = np.zeros(256, np.bool_)
        self._levels[levels] = True
        self._least = levels[0] if levels and levels == [each for each in Severity if each >= levels[0]] else None
        """The severity from which on all pass, where it is as simple as that: a comparison is cheaper than a table."""

    def passing(self, segment: LogSegment, begin: int, end: int) -> Rows:
        """Numbers, rising, of the records from index `begin` to before `end` of a segment that pass."""
        severity = segment.severity[begin:end]
        mask = self._levels[severity] if self._least is None else severity >= self._least
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
