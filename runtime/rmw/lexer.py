"""Split remap and parameter rules into lexemes, numbered as in rcl's messages."""

from __future__ import annotations

import re
from enum import IntEnum


class Lexeme(IntEnum):
    """Kinds of lexeme; the numbers appear in error texts."""

    NONE = 0
    EOF = 1
    TILDE_SLASH = 2
    URL_SERVICE = 3
    URL_TOPIC = 4
    COLON = 5
    NODE = 6
    NS = 7
    SEPARATOR = 8
    BACK_REFERENCE = 9
    TOKEN = 18
    FORWARD_SLASH = 19
    WILD_ONE = 20
    WILD_MULTI = 21
    DOT = 22


class GrammarError(ValueError):
    """A rule is ungrammatical; the message has rcl's wording, `warning` what rcl logs before it, if anything."""

    def __init__(self, text: str, warning: str = "") -> None:
        super().__init__(text)
        self.warning = warning


_PATTERNS = (
    (Lexeme.TILDE_SLASH, r"~/"),
    (Lexeme.URL_SERVICE, r"rosservice://"),
    (Lexeme.URL_TOPIC, r"rostopic://"),
    (Lexeme.SEPARATOR, r":="),
    (Lexeme.COLON, r":"),
    (Lexeme.NODE, r"__(?:node|name)(?![A-Za-z0-9_])"),
    (Lexeme.NS, r"__ns(?![A-Za-z0-9_])"),
    (Lexeme.BACK_REFERENCE, r"\\[1-9]"),
    (Lexeme.TOKEN, r"(?!__)[A-Za-z_][A-Za-z0-9_]*"),
    (Lexeme.FORWARD_SLASH, r"/"),
    (Lexeme.WILD_MULTI, r"\*\*"),
    (Lexeme.WILD_ONE, r"\*"),
    (Lexeme.DOT, r"\."),
)
_SCAN = "|".join(f"({pattern})" for _, pattern in _PATTERNS)


class Lexer:
    """Reads a rule from left to right, looking at most two lexemes ahead."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.index = 0

    def _at(self, index: int) -> tuple[Lexeme, int]:
        if index >= len(self.text):
            return Lexeme.EOF, index
        found = re.compile(_SCAN).match(self.text, index)
        if found is None:
            return Lexeme.NONE, index
        return _PATTERNS[(found.lastindex or 1) - 1][0], found.end()

    def peek(self) -> Lexeme:
        """Return the kind of the next lexeme."""
        return self._at(self.index)[0]

    def peek_two(self) -> tuple[Lexeme, Lexeme]:
        """Return the kinds of the next two lexemes."""
        first, end = self._at(self.index)
        return first, self._at(end)[0]

    def accept(self) -> str:
        """Consume the next lexeme, whatever it is, and return its text."""
        start = self.index
        self.index = self._at(start)[1]
        return self.text[start : self.index]

    def expect(self, kind: Lexeme) -> str:
        """Consume a lexeme of this kind and return its text; raises `GrammarError` if the next one is another."""
        got = self.peek()
        if got == kind:
            return self.accept()
        if got in (Lexeme.NONE, Lexeme.EOF):
            raise GrammarError(f"Expected lexeme type ({kind:d}) not found, search ended at index {self.index}")
        raise GrammarError(f"Expected lexeme type {kind:d}, got {got:d} at index {self.index}")

    def match_token(self) -> str:
        """Consume a token on the left side of a rule; raises `GrammarError`."""
        kind = self.peek()
        if kind == Lexeme.TOKEN:
            return self.accept()
        if kind in (Lexeme.WILD_ONE, Lexeme.WILD_MULTI):
            raise GrammarError(f"Wildcard '{self.accept()}' is not implemented")
        raise GrammarError("Expecting token or wildcard")

    def node_prefix(self) -> str | None:
        """Consume a `node:` prefix, if there is one, and return the node's name, else None."""
        if self.peek_two() != (Lexeme.TOKEN, Lexeme.COLON):
            return None
        name = self.accept()
        self.accept()
        return name
