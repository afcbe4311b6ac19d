"""Remap rules: `[node:]from:=to`, `__node:=name`, `__ns:=/namespace`."""

from __future__ import annotations

from collections.abc import Iterable
from enum import Flag, auto
from typing import NamedTuple

from bot_console.runtime.rmw.lexer import GrammarError, Lexeme, Lexer
from bot_console.runtime.rmw.names import expand


class Kind(Flag):
    """The kinds of name that a rule applies to."""

    TOPIC = auto()
    SERVICE = auto()
    NODE_NAME = auto()
    NAMESPACE = auto()


class RemapRule(NamedTuple):
    """One rule; `node` limits it to nodes of that name."""

    kind: Kind
    node: str | None
    match: str
    replacement: str

    def concerns(self, kind: Kind, node: str) -> bool:
        """Whether the rule is of this kind and applies to this node."""
        return bool(self.kind & kind) and self.node in (None, node)


def parse_rule(text: str) -> RemapRule:
    """Parse a rule; raises `GrammarError` with rcl's wording."""
    lexer = Lexer(text)
    node = lexer.node_prefix()
    kind = lexer.peek()
    if kind == Lexeme.NODE:
        lexer.accept()
        lexer.expect(Lexeme.SEPARATOR)
        rule = RemapRule(Kind.NODE_NAME, node, "", _node_name(lexer))
    elif kind == Lexeme.NS:
        lexer.accept()
        lexer.expect(Lexeme.SEPARATOR)
        rule = RemapRule(Kind.NAMESPACE, node, "", _namespace(lexer))
    else:
        rule = _name_rule(lexer, node)
    lexer.expect(Lexeme.EOF)
    return rule


def _node_name(lexer: Lexer) -> str:
    rest = lexer.text[lexer.index :]
    try:
        return lexer.expect(Lexeme.TOKEN)
    except GrammarError as error:
        raise GrammarError(str(error), f"Node name not remapped to invalid name: '{rest}'") from None


def _namespace(lexer: Lexer) -> str:
    start = lexer.index
    try:
        lexer.expect(Lexeme.FORWARD_SLASH)
        while lexer.peek() == Lexeme.TOKEN:
            lexer.accept()
            if lexer.peek() != Lexeme.FORWARD_SLASH:
                break
            lexer.accept()
        end = lexer.index
        lexer.expect(Lexeme.EOF)
    except GrammarError as error:
        found = f"Namespace not remapped to a fully qualified name (found: {lexer.text[start:]})"
        raise GrammarError(str(error), found) from None
    return lexer.text[start:end]


def _name_rule(lexer: Lexer, node: str | None) -> RemapRule:
    kinds = {Lexeme.URL_TOPIC: Kind.TOPIC, Lexeme.URL_SERVICE: Kind.SERVICE}
    kind = kinds.get(lexer.peek())
    if kind:
        lexer.accept()
    start = lexer.index
    if lexer.peek() in (Lexeme.TILDE_SLASH, Lexeme.FORWARD_SLASH):
        lexer.accept()
    lexer.match_token()
    while lexer.peek() != Lexeme.SEPARATOR:
        lexer.expect(Lexeme.FORWARD_SLASH)
        lexer.match_token()
    match = lexer.text[start : lexer.index]
    lexer.expect(Lexeme.SEPARATOR)
    return RemapRule(kind or Kind.TOPIC | Kind.SERVICE, node, match, _replacement(lexer))


def _replacement(lexer: Lexer) -> str:
    start = lexer.index
    if lexer.peek() in (Lexeme.TILDE_SLASH, Lexeme.FORWARD_SLASH):
        lexer.accept()
    _replacement_token(lexer)
    while lexer.peek() != Lexeme.EOF:
        lexer.expect(Lexeme.FORWARD_SLASH)
        _replacement_token(lexer)
    return lexer.text[start : lexer.index]


def _replacement_token(lexer: Lexer) -> None:
    kind = lexer.peek()
    if kind == Lexeme.BACK_REFERENCE:
        raise GrammarError("Backreferences are not implemented")
    if kind != Lexeme.TOKEN:
        raise GrammarError("error not set")
    lexer.accept()


def remap_node_name(rules: Iterable[RemapRule], name: str) -> str | None:
    """Return the name that the first matching rule gives a node, or None."""
    return _first(rules, Kind.NODE_NAME, name)


def remap_namespace(rules: Iterable[RemapRule], name: str) -> str | None:
    """Return the namespace that the first matching rule gives a node, or None."""
    return _first(rules, Kind.NAMESPACE, name)


def _first(rules: Iterable[RemapRule], kind: Kind, name: str) -> str | None:
    return next((rule.replacement for rule in rules if rule.concerns(kind, name)), None)


def remap_topic(rules: Iterable[RemapRule], node: str, namespace: str, full: str) -> str:
    """Return a topic's full name, replaced if a rule matches it; the first match counts."""
    return _remap(rules, Kind.TOPIC, node, namespace, full)


def remap_service(rules: Iterable[RemapRule], node: str, namespace: str, full: str) -> str:
    """Return a service's full name, replaced if a rule matches it; the first match counts."""
    return _remap(rules, Kind.SERVICE, node, namespace, full)


def _remap(rules: Iterable[RemapRule], kind: Kind, node: str, namespace: str, full: str) -> str:
    for rule in rules:
        if rule.concerns(kind, node) and expand(rule.match, node, namespace) == full:
            return expand(rule.replacement, node, namespace)
    return full
