"""Patterns compiled by google-re2, with which `hits` searches many texts. Otherwise uses only the standard library."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

Match = Callable[[Any, bytes, int, int], "list[tuple[int, int]]"]
"""Finds the first match in bytes between two positions; returns its start and end, negative if there is none."""
FLAGS = "(?im)"
PART = re.compile(r"\\.|\[\^?\]?(?:\\.|[^\]\\])*\]|\(\?[a-zA-Z-]*|.", re.DOTALL)
"""The parts of a pattern: an escape, a character class, the flags of a group, or a character."""
WITHIN = {r"\s": r"[\t\f\r ]", r"\D": r"[^\d\n]", r"\W": r"[^\w\n]"}
"""Character classes, each with an equivalent that does not match a newline."""


class Re2Engine:
    """A compiled pattern; raises `ValueError` with a readable message. `word` is a plain word in lower case."""

    def __init__(self, re2: Any, written: str, body: str, word: bytes | None) -> None:
        self.anywhere = re2._Anchor.UNANCHORED
        self.word = re.escape(word) if word is not None else None
        self.match = _compile(re2, written, FLAGS + body)
        within = within_lines(body)
        self.over = within != body
        """Whether a match may extend over the end of a line in a text of several lines."""
        self.run: Match | None = None
        """Finds a run of whole lines that all match, which is cheaper if many do; None where that is not possible."""
        if within is not None:
            self.run = _compile(re2, written, f"{FLAGS}(?:^[^\\n]*(?:{within})[^\\n]*\\n)+")

    def search(self, text: bytes) -> bool:
        """Whether it matches anywhere in a text."""
        return self.match(self.anywhere, text, 0, len(text))[0][0] >= 0


def within_lines(body: str) -> str | None:
    """A pattern that finds the same matches, except those that extend over the end of a line; None if that is unclear.

    If no match of the pattern can extend over the end of a line, the pattern is returned unchanged.
    """
    parts: list[str] = []
    for part in PART.findall(body):
        if part.startswith("(?") and "s" in part:
            return None
        if part in (r"\n", r"\C", r"\p", r"\P", r"\Q") or (
            part[0] == "[" and re.search(r"\\[nsDWpPx0-7]|\[:|\n", part)
        ):
            return None
        if re.fullmatch(r"\\[x0-7]|\n", part):
            return None
        parts.append(part[:-1] + r"\n]" if part.startswith("[^") else WITHIN.get(part) or part)
    return "".join(parts)


def _compile(re2: Any, written: str, pattern: str) -> Match:
    options = re2.Options()
    options.log_errors = False  # errors would be written to the terminal
    options.never_capture = True
    try:
        compiled = re2.compile(pattern.encode("utf-8", "replace"), options=options)
    except re2.error as error:
        why = error.args[0] if error.args else error
        why = why.decode("utf-8", "replace") if isinstance(why, bytes) else str(why)
        raise ValueError(f"regular expression '{written}': {why.partition(': (?im)')[0]}") from None
    return compiled._regexp.Match
