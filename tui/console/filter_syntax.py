"""Parses filters, in the grammar that all panes share.

    filter  = words separated by blanks; all of them must match
    word    = [!] [node: | topic: | sev: | at: | time: | re:] text   `!` negates any word
    text    = without blanks, or "in quotes with blanks"

`node:` matches part of a node's name in either spelling (`arm.left.zoo`, `/arm/left/zoo`), `node:=` the whole name,
`node:arm|base` either of two; `topic:scan|odom` matches a topic's name, or the text where there is no topic; `sev:`
matches the severity of a log line (`warn`, `>=warn`, `<error`, `info,fatal`), `at:` where it was logged (`file.py`,
`file.py:12`, a function), and `time:` when (see `spans`); `re:` is a regular expression for the text. A plain word may
be part of the text or of the node's name. Matching ignores case.
"""

from __future__ import annotations

import re
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from bot_console.tui.console.logs.patterns import Pattern
from bot_console.tui.console.logs.time_filter import Span, parse_span
from bot_console.tui.console.model import LogRecord, Severity

SEVERITY_WORDS: Mapping[str, Severity] = {
    "unset": Severity.UNSET,
    "debug": Severity.DEBUG,
    "info": Severity.INFO,
    "warn": Severity.WARN,
    "warning": Severity.WARN,
    "error": Severity.ERROR,
    "fatal": Severity.FATAL,
}
ALL = frozenset(Severity)
_WORD = re.compile(r'(!?)(?:(node|topic|sev|at|time|re):)?(?:"([^"]*)"(?=\s|$)|(\S*))(?:\s+|$)')


@dataclass(frozen=True, slots=True)
class NodeTerm:
    """Part of a node's name in the dotted spelling, or the whole name; `others` are alternatives."""

    part: str
    exclude: bool = False
    whole: bool = False
    others: tuple[NodeTerm, ...] = ()

    def stands_in(self, node: str) -> bool:
        """Whether a node's name matches."""
        name = dotted(node)
        found = self.part == name if self.whole else self.part in name
        return found or any(each.stands_in(node) for each in self.others)


@dataclass(frozen=True, slots=True)
class PlaceTerm:
    """Part of the name of a file or function, with a line number if one was given."""

    part: str
    line: int | None
    exclude: bool = False

    def stands_in(self, file: str, function: str, line: int) -> bool:
        """Whether a place in the source code matches."""
        return (self.line is None or self.line == line) and (
            self.part in file.lower() or self.part in function.lower() if self.part else self.line is not None
        )


@dataclass(frozen=True, slots=True)
class SpanTerm:
    """A span of time that a log line must, or with `exclude` must not, be in."""

    span: Span
    exclude: bool = False


@dataclass(frozen=True, slots=True)
class TextTerm:
    """A pattern for a text. A plain word also matches the node's name; a regular expression does not."""

    pattern: Pattern
    name: NodeTerm | None
    exclude: bool = False


@dataclass(frozen=True, slots=True)
class Query:
    """A parsed filter. Severities, places and times only apply to log lines."""

    nodes: tuple[NodeTerm, ...] = ()
    texts: tuple[TextTerm, ...] = ()
    severities: frozenset[Severity] = ALL
    places: tuple[PlaceTerm, ...] = ()
    spans: tuple[SpanTerm, ...] = ()

    @property
    def terms(self) -> tuple[NodeTerm | TextTerm, ...]:
        """The terms that match texts and names."""
        return (*self.nodes, *self.texts)

    def part(self, *, exclude: bool) -> Query:
        """Only the terms that exclude, or only the others."""
        nodes = tuple(each for each in self.nodes if each.exclude is exclude)
        return Query(nodes, tuple(each for each in self.texts if each.exclude is exclude))

    def matches(self, text: str, node: str = "") -> bool:
        """Whether a text of a node passes, ignoring the terms that only apply to log lines."""
        if any(term.stands_in(node) is term.exclude for term in self.nodes):
            return False
        return all(self.found(term, text, node) is not term.exclude for term in self.texts)

    def passes(self, record: LogRecord) -> bool:
        """Whether a log line passes."""
        return (
            record.severity in self.severities
            and all(each.span.holds(record.stamp) is not each.exclude for each in self.spans)
            and all(
                each.stands_in(record.file, record.function, record.line) is not each.exclude for each in self.places
            )
            and self.matches(record.text, record.node)
        )

    @staticmethod
    def found(term: TextTerm, text: str, node: str) -> bool:
        """Whether a term matches a text or the name of its node."""
        return term.pattern.search(text) or (term.name is not None and term.name.stands_in(node))


def dotted(node: str) -> str:
    """A node's name in a common form of both spellings: `/Arm/left` and `arm.left` become `.arm.left`."""
    return "." + node.lower().replace("/", ".").lstrip(".")


def parse(text: str, *, lists: bool = False) -> Query:
    """Parse a filter; raises `ValueError` with a readable message for a bad pattern, severity or time.

    With `lists`, a plain word such as `scan|odom` matches either of the two.
    """
    nodes: list[NodeTerm] = []
    texts: list[TextTerm] = []
    places: list[PlaceTerm] = []
    spans: list[SpanTerm] = []
    severities = ALL
    for sign, field, quoted, bare in _WORD.findall(text.strip()):
        word = quoted or bare
        if not word:
            if sign and not field:
                texts.append(_plain("!", exclude=False))  # a lone exclamation mark is an ordinary word
            continue
        exclude = bool(sign)
        choices = [each for each in word.split("|") if each]
        if field == "topic" and choices:
            texts.append(TextTerm(_any_of(choices), None, exclude))
        elif field == "node" and len(choices) > 1:
            first, *others = (_node(each, exclude) for each in choices)
            nodes.append(replace(first, others=tuple(others)))
        elif lists and not field and not quoted and len(choices) > 1:
            first, *others = (NodeTerm(_part(each)) for each in choices)
            texts.append(TextTerm(_any_of(choices), replace(first, others=tuple(others)), exclude))
        elif field == "sev":
            wanted = _severities(word)
            severities = severities - wanted if exclude else severities & wanted
        elif field == "node":
            nodes.append(_node(word, exclude))
        elif field == "at":
            places.append(_place(word, exclude))
        elif field == "time":
            spans.append(SpanTerm(parse_span(word, time.time_ns()), exclude))
        elif field == "re":
            texts.append(TextTerm(Pattern(word), None, exclude))
        else:
            texts.append(_plain(word, exclude))
    return Query(tuple(nodes), tuple(texts), severities, tuple(places), tuple(spans))


def _node(word: str, exclude: bool) -> NodeTerm:
    name = word.removeprefix("=")
    return NodeTerm(_part(word), exclude) if name in (word, "") else NodeTerm(dotted(name), exclude, whole=True)


def _place(word: str, exclude: bool) -> PlaceTerm:
    name, colon, line = word.rpartition(":")
    if colon and line.isdecimal() and len(line) < 10:
        return PlaceTerm(name.lower(), int(line), exclude)
    return PlaceTerm(word.lower(), None, exclude)


def _any_of(words: Sequence[str]) -> Pattern:
    """A pattern that matches any of several plain words."""
    return Pattern("|".join(map(re.escape, words))) if len(words) > 1 else Pattern(words[0], literal=True)


def _part(word: str) -> str:
    return word.lower().replace("/", ".")


def _plain(word: str, exclude: bool) -> TextTerm:
    return TextTerm(Pattern(word, literal=True), NodeTerm(_part(word)), exclude)


def _severities(text: str) -> frozenset[Severity]:
    """Parse severities such as `warn`, `>=warn`, `<error` or `info,fatal`."""
    found: frozenset[Severity] = frozenset()
    for each in text.split(","):
        sign = next((sign for sign in (">=", "<=", ">", "<", "=") if each.startswith(sign)), "")
        word = each[len(sign) :].lower()
        if word not in SEVERITY_WORDS:
            raise ValueError(f"severity '{word}' is unknown; use one of {', '.join(SEVERITY_WORDS)}")
        level = SEVERITY_WORDS[word]
        found |= {
            one
            for one in Severity
            if (one == level and sign not in {"<", ">"})
            or (one > level and sign.startswith(">"))
            or (one < level and sign.startswith("<"))
        }
    return found
