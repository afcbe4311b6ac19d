"""Regular expressions that a person types. They never take longer than the text is long.

The engine is google-re2, which does not backtrack and lets other threads run meanwhile. Where it has no wheel Python's
own takes its place, and patterns that could make that one backtrack without end are refused.
"""

from __future__ import annotations

import importlib
import re
from collections.abc import Callable
from typing import Any, Protocol

FLAGS = "(?im)"


def _engine() -> Any:
    try:
        return importlib.import_module("re2")
    except ImportError:  # no wheel for this platform
        return None


re2 = _engine()


class Spans(Protocol):
    """Looks for the first match in bytes from a place on: its begin and end, or None."""

    def __call__(self, blob: bytes, start: int) -> tuple[int, int] | None:
        """The first match from `start` on."""
        ...


class Pattern:
    """A pattern without regard to case, `^` and `$` meaning each line; raises `ValueError` with a readable text."""

    def __init__(self, text: str, *, literal: bool = False) -> None:
        body = _escaped(text) if literal else text
        if not literal and re.search(r"\\[AzZ]", text):
            raise ValueError(f"regular expression '{text}': use ^ and $ for the begin and end of a line")
        self.word = re.escape(text.lower().encode()) if literal and text.isascii() else None
        """A plain word in lower case, for those who look through texts in lower case."""
        compile_ = _python_spans if re2 is None else _re2_spans
        self.first = compile_(text, FLAGS + body)
        self.run: Spans | None = None
        """Finds a run of whole lines that all have a match: cheaper where many have one. Only for single lines."""
        if not re.search(r"\(\?[a-zA-Z-]*s|\\n|\[\^|\\[sSWDPC]|\\p|\[:", body):
            self.run = compile_(text, f"{FLAGS}(?:^[^\\n]*(?:{body})[^\\n]*\\n)+")

    def search(self, text: str) -> bool:
        """Whether it is found in a text."""
        return self.first(text.encode("utf-8", "replace"), 0) is not None


def _escaped(text: str) -> str:
    return "".join(letter if letter.isalnum() or not letter.isascii() else "\\" + letter for letter in text)


def _re2_spans(written: str, pattern: str) -> Spans:
    options = re2.Options()
    options.log_errors = False  # it would write to the terminal
    options.never_capture = True
    try:
        compiled = re2.compile(pattern.encode("utf-8", "replace"), options=options)
    except re2.error as error:
        why = error.args[0] if error.args else error
        why = why.decode("utf-8", "replace") if isinstance(why, bytes) else str(why)
        raise ValueError(f"regular expression '{written}': {why.partition(': (?im)')[0]}") from None
    match: Callable[..., Any] = compiled._regexp.Match
    anywhere = re2._Anchor.UNANCHORED

    def first(blob: bytes, start: int) -> tuple[int, int] | None:
        begin, end = match(anywhere, blob, start, len(blob))[0]
        return None if begin < 0 else (begin, end)

    return first


def _python_spans(written: str, pattern: str) -> Spans:
    _refuse_backtracking(written)
    try:
        compiled = re.compile(pattern.encode("utf-8", "replace"))
    except re.error as error:
        raise ValueError(f"regular expression '{written}': {error.msg}") from None

    def first(blob: bytes, start: int) -> tuple[int, int] | None:
        found = compiled.search(blob, start)
        return found.span() if found else None

    return first


def _refuse_backtracking(written: str) -> None:
    """Refuse a repetition inside a repetition, and more than two in all: these take time without bound."""
    bare = re.sub(r"\\.|\[[^\]]*\]", "x", written)
    repeats = len(re.findall(r"[*+]|\{\d*,\d*\}", bare))
    if repeats > 2 or re.search(r"\((?:[^()]*[*+}|])[^()]*\)[*+{]", bare) or re.search(r"\)\)+[*+{]", bare):
        raise ValueError(f"regular expression '{written}': too costly without google-re2, which is not installed here")
