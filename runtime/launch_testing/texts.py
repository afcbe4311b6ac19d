"""Searches for expected texts and lines; a match is a pair of start and end."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterable, Sequence
from typing import Any

Span = tuple[int, int]
TextMatch = Callable[..., Span | None]
ANSI_ESCAPE = re.compile(r"\x1b\[[0-9;:]*[A-Za-z]")


def remove_ansi_escape_sequences(text: str) -> str:
    """Return a text without its colours."""
    return ANSI_ESCAPE.sub("", text)


def normalize_lineseps(lines: str) -> str:
    """Return a text in which each line ends in a single newline, including those that a terminal has converted."""
    return lines.replace(os.linesep, "\n").replace("\r\n", "\n")


def build_line_match(expected_lines: Any, *, strict: bool = False) -> TextMatch:
    """Return a function that finds expected lines among lines, starting at a given one.

    A text is searched for within a line, a regular expression at its beginning. Each of several is searched for after
    the previous one; if strict, they begin with the first line and follow each other, and a single one matches whole
    lines. Raises `ValueError` for anything else.
    """
    if isinstance(expected_lines, str):
        fits = (lambda line: line == expected_lines) if strict else (lambda line: expected_lines in line)
    elif hasattr(expected_lines, "match"):
        fits = expected_lines.match
    elif isinstance(expected_lines, Iterable):
        return _in_order([build_line_match(each) for each in expected_lines], strict)
    else:
        raise ValueError("Unknown format for expected lines")

    def match(actual_lines: Sequence[str], start: int = 0) -> Span | None:
        if strict:
            return (start, len(actual_lines)) if all(map(fits, actual_lines[start:])) else None
        return next(((at, at + 1) for at in range(start, len(actual_lines)) if fits(actual_lines[at])), None)

    return match


def build_text_match(expected_text: Any, *, strict: bool = False) -> TextMatch:
    """Return a function that finds an expected text in a text, starting at a given position.

    The expectation is a text, a regular expression, or several of these, each searched for after the previous one; if
    strict, a text must equal the whole rest, and an expression must match at that position. Raises `ValueError` for
    anything else.
    """
    if isinstance(expected_text, str):
        return _match_whole(expected_text) if strict else _match_within(expected_text)
    if hasattr(expected_text, "search") and hasattr(expected_text, "match"):
        find = expected_text.match if strict else expected_text.search

        def match(actual_text: str, start: int = 0) -> Span | None:
            found = find(normalize_lineseps(actual_text), start)
            return found and found.span()

        return match
    if isinstance(expected_text, Iterable):
        return _in_order([build_text_match(each) for each in expected_text], strict)
    raise ValueError("Unknown format for expected text")


def _match_whole(expected: str) -> TextMatch:
    def match(actual_text: str, start: int = 0) -> Span | None:
        return (start, start + len(expected)) if normalize_lineseps(actual_text)[start:] == expected else None

    return match


def _match_within(expected: str) -> TextMatch:
    def match(actual_text: str, start: int = 0) -> Span | None:
        found = normalize_lineseps(actual_text).find(expected, start)
        return None if found < 0 else (found, found + len(expected))

    return match


def _in_order(matches: list[TextMatch], strict: bool) -> TextMatch:
    """Combine matches one after the other; if strict, with nothing before the first and between them."""
    if not matches:
        raise ValueError("nothing is expected: give at least one text")

    def match(actual: object, start: int = 0) -> Span | None:
        begin: int | None = None
        end = start
        for each in matches:
            found = each(actual, end)
            if found is None or (strict and found[0] != end):
                return None
            begin, end = found[0] if begin is None else begin, found[1]
        return start if begin is None else begin, end

    return match
