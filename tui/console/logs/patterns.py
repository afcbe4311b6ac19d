"""Regular expressions that a person types. They never take longer than the text is long, and never the console's time.

The engine is google-re2, which does not backtrack and lets other threads run meanwhile. Where it has no wheel, Python's
own takes its place in a process of its own, which is killed when it takes too long (`regex_process`).
"""

from __future__ import annotations

import importlib
import re
from typing import Any, TypeAlias

from bot_console.tui.console.logs.re2_engine import Re2Engine
from bot_console.tui.console.logs.regex_process import ProcessEngine

Engine: TypeAlias = "Re2Engine | WordEngine | ProcessEngine"


def _library() -> Any:
    try:
        return importlib.import_module("re2")
    except ImportError:  # no wheel for this platform
        return None


re2 = _library()


class Pattern:
    """A case-insensitive pattern, `^` and `$` matching at each line; raises `ValueError` with a readable message."""

    def __init__(self, text: str, *, literal: bool = False) -> None:
        body = _escaped(text) if literal else text
        if not literal and re.search(r"\\[AzZ]", text):
            raise ValueError(f"regular expression '{text}': use ^ and $ for the begin and end of a line")
        self.engine = _engine(text, body, literal)
        self.plain = text.lower() if literal else None
        """A plain word in lower case, for those who have texts in lower case."""

    def search(self, text: str) -> bool:
        """Whether it matches in a text."""
        return self.engine.search(text.encode("utf-8", "replace"))


def _engine(written: str, body: str, literal: bool) -> Engine:
    word = written.lower().encode() if literal and written.isascii() else None
    if re2 is not None:
        return Re2Engine(re2, written, body, word)
    return WordEngine(written) if literal else ProcessEngine(written)


def _escaped(text: str) -> str:
    return "".join(
        character if character.isalnum() or not character.isascii() else "\\" + character for character in text
    )


class WordEngine:
    """A plain word, where google-re2 is not installed."""

    def __init__(self, word: str) -> None:
        self.word = word.lower()

    def search(self, text: bytes) -> bool:
        """Whether it occurs in a text."""
        return self.word in text.decode("utf-8", "replace").lower()
