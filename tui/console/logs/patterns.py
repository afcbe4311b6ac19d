"""Regular expressions typed by users. Matching takes time linear in the text and never blocks the console.

The engine is google-re2, which does not backtrack and releases the interpreter lock. Python's `re` does neither, so on
platforms without a wheel of google-re2 only plain words can be searched for.
"""

from __future__ import annotations

import importlib
import re
from typing import Any, TypeAlias

from bot_console.tui.console.logs.re2_engine import Re2Engine

Engine: TypeAlias = "Re2Engine | WordEngine"
NO_REGEX = (
    "regular expression '{}': this needs google-re2, which is not installed (it has no wheel for some platforms); "
    "use words"
)


def _library() -> Any:
    try:
        return importlib.import_module("re2")
    except ImportError:  # no wheel for this platform
        return None


re2 = _library()


class Pattern:
    """A case-insensitive pattern whose `^` and `$` match at each line; raises `ValueError` with a readable message."""

    def __init__(self, text: str, *, literal: bool = False) -> None:
        body = _escaped(text) if literal else text
        if not literal and re.search(r"\\[AzZ]", text):
            raise ValueError(f"regular expression '{text}': use ^ and $ for the start and end of a line")
        self.engine = _engine(text, body, literal)
        self.plain = text.lower() if literal else None
        """A plain word in lower case, for callers that search texts in lower case."""

    def search(self, text: str) -> bool:
        """Whether it matches anywhere in a text."""
        return self.engine.search(text.encode("utf-8", "replace"))


def _engine(written: str, body: str, literal: bool) -> Engine:
    word = written.lower().encode() if literal and written.isascii() else None
    if re2 is not None:
        return Re2Engine(re2, written, body, word)
    if not literal:
        raise ValueError(NO_REGEX.format(written))
    return WordEngine(written)


def _escaped(text: str) -> str:
    return "".join(
        character if character.isalnum() or not character.isascii() else "\\" + character for character in text
    )


class WordEngine:
    """Searches for a plain word where google-re2 is not installed."""

    def __init__(self, word: str) -> None:
        self.word = word.lower()

    def search(self, text: bytes) -> bool:
        """Whether the word occurs in a text."""
        return self.word in text.decode("utf-8", "replace").lower()
