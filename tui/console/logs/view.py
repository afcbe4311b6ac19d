"""A live search of the log, independent of the threads that draw and of those that log.

A separate thread searches in slices: the newest records first, then whatever has arrived since. The panes poll for what
has been found.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, replace

from bot_console.tui.console.logs.port import LogFindings, LogView
from bot_console.tui.console.logs.repeat_folding import Block, FoldedNumbers, Numbers
from bot_console.tui.console.logs.search import LogSearch
from bot_console.tui.console.logs.store import LogSegment, LogStore
from bot_console.tui.console.model import LogFilter

FIRST_SLICE_RECORDS = 2048
"""The number of records searched before anything is shown: a few screenfuls."""
BUDGET_S = 5.0
"""Processor time (s) that one filter may take for the records that existed when it was requested."""


@dataclass(frozen=True, slots=True)
class SearchResult(LogFindings):
    """Findings to which older and newer numbers can be added."""

    numbers: Numbers | FoldedNumbers


class SearchedView:
    """The search of a store with one filter. `poll` may be called from any thread; `work` from one at a time."""

    def __init__(self, store: LogStore, which: LogFilter, wake: Callable[[], None] = lambda: None) -> None:
        self._store = store
        self._wake = wake
        end = store.state.end
        self._spent = 0.0
        self._search: LogSearch | None = None
        self._folds = which.folded
        self._found: SearchResult = SearchResult(FoldedNumbers() if which.folded else Numbers(), end, end)
        try:
            self._search = LogSearch(store, which)
        except ValueError as error:
            self._found = replace(self._found, problem=str(error), complete=True)

    def poll(self) -> SearchResult:
        """The records found so far; the same object until there is more."""
        found, there = self._found, self._store.state
        if not found.complete or there.end != found.end or there.first > found.begin:
            self._wake()
        return found

    def work(self) -> bool:
        """Search one slice; returns False if there is nothing to do."""
        if self._search is None:
            return False
        first, found = self._store.segments[0].first, self._found
        if first > found.begin or (first > found.end):
            found = self._found = replace(found, numbers=found.numbers.since(first), begin=max(first, found.begin),
                                          end=max(first, found.end))  # fmt: skip
        started = time.thread_time()
        new = self._search_newer(self._search, found) or (
            None if found.complete else self._search_older(self._search, found)
        )
        if new is None:
            return False
        self._found = new
        if not new.complete:
            self._spent += time.thread_time() - started
            if self._spent > BUDGET_S:
                polled = f"only the newest {new.end - new.begin} lines were searched"
                self._found = replace(new, complete=True, problem=f"this filter is too costly: {polled}")
        return True

    def _search_newer(self, search: LogSearch, found: SearchResult) -> SearchResult | None:
        for segment in self._store.segments:
            count = segment.count
            if segment.first <= found.end < segment.first + count:
                numbers = search.passing(segment, found.end - segment.first, count)
                joined = found.numbers.joined(newer=numbers, keys=self._keys(segment, numbers))
                return replace(found, numbers=joined, end=segment.first + count)
        return None

    def _search_older(self, search: LogSearch, found: SearchResult) -> SearchResult:
        for segment in reversed(self._store.segments):
            if segment.first < found.begin:
                last = min(found.begin - segment.first, segment.count)
                begin = max(0, last - FIRST_SLICE_RECORDS) if not len(found.numbers) else 0
                numbers = search.passing(segment, begin, last)
                joined = found.numbers.joined(older=numbers, keys=self._keys(segment, numbers))
                return replace(found, numbers=joined, begin=segment.first + begin)
        return replace(found, complete=True)

    def _keys(self, segment: LogSegment, numbers: Block) -> Block | None:
        """The keys of records in a segment if runs of equal records are to be folded, else None."""
        return segment.key[numbers - segment.first] if self._folds else None


class LogViews:
    """All searches over a store, and the thread that runs them."""

    def __init__(self, store: LogStore) -> None:
        self._store = store
        self._views: tuple[SearchedView, ...] = ()
        self._wanted = threading.Event()
        self._closed = False
        self._thread: threading.Thread | None = None

    def open(self, which: LogFilter, instead_of: LogView | None = None) -> SearchedView:
        """Start a search, which replaces the one given as `instead_of`."""
        view = SearchedView(self._store, which, self.wake)
        self._views = (*(each for each in self._views if each is not instead_of), view)
        if self._thread is None and not self._closed:
            self._thread = threading.Thread(target=self._work, name="log search", daemon=True)
            self._thread.start()
        self.wake()
        return view

    def wake(self) -> None:
        """Wake up the search thread because there may be something to do."""
        self._wanted.set()

    def close(self) -> None:
        """Stop searching."""
        self._closed = True
        self._wanted.set()

    def _work(self) -> None:
        while not self._closed:
            self._wanted.wait()
            self._wanted.clear()
            while not self._closed and any([each.work() for each in self._views]):
                time.sleep(0)
