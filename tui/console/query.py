"""The filter grammar that every pane speaks: blanks mean AND, `!word` excludes, `re:pattern` is a regular expression,
`node:name` and `sev:>=warn` look at one property. Standard library only.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from bot_console.tui.console.model import Severity

FIELDS = ("node", "sev", "re")
SEVERITY_WORDS: Mapping[str, Severity] = {
    "debug": Severity.DEBUG,
    "info": Severity.INFO,
    "warn": Severity.WARN,
    "warning": Severity.WARN,
    "error": Severity.ERROR,
    "fatal": Severity.FATAL,
}


@dataclass(frozen=True, slots=True)
class Term:
    """One word of a query: what it looks at (empty: the text), the pattern that finds it, and whether it excludes."""

    field: str
    pattern: re.Pattern[str]
    exclude: bool = False


@dataclass(frozen=True, slots=True)
class Query:
    """A parsed filter text; `lowest` and `highest` bound the severity."""

    terms: tuple[Term, ...] = ()
    lowest: Severity = Severity.UNSET
    highest: Severity = Severity.FATAL

    def matches(self, text: str, node: str = "") -> bool:
        """Whether a text, belonging to a node, passes; a plain word may stand in either."""
        for term in self.terms:
            found = bool(term.pattern.search(node)) if term.field == "node" else self._stands_in(term, text, node)
            if found is term.exclude:
                return False
        return True

    @staticmethod
    def _stands_in(term: Term, text: str, node: str) -> bool:
        return bool(term.pattern.search(text) or (term.field == "" and term.pattern.search(node)))


def parse(text: str) -> Query:
    """Parse a filter text; raises `ValueError` with a readable text for a bad pattern or severity."""
    terms: list[Term] = []
    lowest, highest = Severity.UNSET, Severity.FATAL
    for word in text.split():
        exclude = len(word) > 1 and word.startswith("!")
        field, rest = _field_of(word[1:] if exclude else word)
        if field == "sev":
            lowest, highest = _severity_bounds(rest)
        elif rest:
            terms.append(Term(field, _compile(field, rest), exclude))
    return Query(tuple(terms), lowest, highest)


def _field_of(word: str) -> tuple[str, str]:
    name, colon, rest = word.partition(":")
    return (name, rest) if colon and name in FIELDS else ("", word)


def _compile(field: str, text: str) -> re.Pattern[str]:
    try:
        return re.compile(text if field == "re" else re.escape(text), re.IGNORECASE | re.MULTILINE)
    except re.error as error:
        place = "" if error.pos is None else f" at character {error.pos + 1}"
        raise ValueError(f"regular expression '{text}': {error.msg}{place}") from None


def _severity_bounds(text: str) -> tuple[Severity, Severity]:
    operator = next((sign for sign in (">=", "<=", ">", "<", "=") if text.startswith(sign)), "")
    word = text[len(operator) :].lower()
    try:
        level = SEVERITY_WORDS[word]
    except KeyError:
        raise ValueError(f"severity '{word}' is none of {', '.join(SEVERITY_WORDS)}") from None
    order = [Severity.DEBUG, Severity.INFO, Severity.WARN, Severity.ERROR, Severity.FATAL]
    at = order.index(level)
    if operator == ">":
        return (order[at + 1] if at + 1 < len(order) else Severity.FATAL), Severity.FATAL
    if operator == "<":
        return Severity.UNSET, order[max(0, at - 1)]
    return {">=": (level, Severity.FATAL), "<=": (Severity.UNSET, level)}.get(operator, (level, level))
