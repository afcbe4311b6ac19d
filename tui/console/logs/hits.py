"""Finds which of many texts match a pattern, by searching a blob that contains them all instead of text by text."""

from __future__ import annotations

import re
from array import array
from collections.abc import Iterable, Iterator

import numpy as np
import numpy.typing as npt
from bot_console.tui.console.logs.patterns import Pattern, WordEngine
from bot_console.tui.console.logs.re2_engine import Match, Re2Engine

Mask = npt.NDArray[np.bool_]
Rows = npt.NDArray[np.int64]
MAX_SINGLE_MATCHES = 64
"""Matches in one blob after which the search continues with runs of matching lines instead of single matches."""


def hits(pattern: Pattern, blob: bytes, ends: Rows) -> Mask:
    """Mark the texts that match; `ends` are the positions in the blob at which they end, including their newlines."""
    engine = pattern.engine
    if isinstance(engine, Re2Engine):
        return _re2_hits(engine, blob, ends)
    return _word_hits(engine, blob, ends)


def _word_hits(engine: WordEngine, blob: bytes, ends: Rows) -> Mask:
    if engine.word.isascii():
        found = np.zeros(len(ends), np.bool_)
        places = np.fromiter(_places(engine.word.encode(), blob.lower()), np.int64)
        found[np.searchsorted(ends, places, side="right")] = True
        return found
    spans = zip([0, *ends[:-1].tolist()], ends.tolist(), strict=True)
    return np.fromiter((engine.search(blob[begin : end - 1]) for begin, end in spans), np.bool_)


def _places(word: bytes, blob: bytes) -> Iterable[int]:
    at = blob.find(word)
    while at >= 0:
        yield at
        at = blob.find(word, at + 1)


def _re2_hits(engine: Re2Engine, blob: bytes, ends: Rows) -> Mask:
    found = np.zeros(len(ends), np.bool_)
    at = 0
    for count, row in enumerate(_rows(engine, blob, ends)):
        found[row] = True
        at = int(ends[row])
        if count == MAX_SINGLE_MATCHES and engine.word is not None:
            places = [match.start() for match in re.finditer(engine.word, blob[at:].lower())]
            found[np.searchsorted(ends, np.array(places, np.int64) + at, side="right")] = True
            break
        if count == MAX_SINGLE_MATCHES and engine.run is not None:
            _mark_runs(engine, engine.run, blob, ends, at, found)
            if engine.over:
                _mark_texts_of_many_lines(engine, blob, ends, row, found)
            break
    return found


def _mark_texts_of_many_lines(engine: Re2Engine, blob: bytes, ends: Rows, after: int, found: Mask) -> None:
    """Search the remaining texts of several lines one by one, since a match in them may span lines."""
    lines = np.flatnonzero(np.frombuffer(blob, np.uint8) == ord("\n")) + 1
    for row in set(np.searchsorted(ends, np.setdiff1d(lines, ends, assume_unique=True), side="right").tolist()):
        if row > after and not found[row]:
            found[row] = engine.search(blob[int(ends[row - 1]) : int(ends[row]) - 1])


def _rows(engine: Re2Engine, blob: bytes, ends: Rows) -> Iterator[int]:
    """The texts with a match, found with one search each; a match that extends into the next text is checked again."""
    at, length = 0, len(blob)
    while at < length:
        first, last = engine.match(engine.anywhere, blob, at, length)[0]
        if first < 0 or first >= length:
            return
        row = int(np.searchsorted(ends, first, side="right"))
        begin, end = int(ends[row - 1]) if row else 0, int(ends[row])
        if last < end or engine.search(blob[begin : end - 1]):
            yield row
        at = end


def _mark_runs(engine: Re2Engine, run: Match, blob: bytes, ends: Rows, at: int, found: Mask) -> None:
    """Mark the texts from position `at` on that have a matching line, with one search for each run of such lines."""
    spans = array("q")
    add, anywhere, length = spans.extend, engine.anywhere, len(blob)
    while at < length:
        span = run(anywhere, blob, at, length)[0]
        at = span[1]
        if at < 0:
            break
        add(span)
    if not spans:
        return
    places = np.frombuffer(spans, np.int64)
    firsts = np.searchsorted(ends, places[::2], side="right")
    lasts = np.searchsorted(ends, places[1::2] - 1, side="right")
    rows = len(ends)
    steps = np.bincount(firsts, minlength=rows + 1) - np.bincount(lasts + 1, minlength=rows + 1)
    found |= np.cumsum(steps[:rows]) > 0
