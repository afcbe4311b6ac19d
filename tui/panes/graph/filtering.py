"""The filter of the graph: which nodes and topics are drawn, and how a filter word is completed. Pure."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import product

from bot_console.tui.console.filter_syntax import NodeTerm, Query, TextTerm
from bot_console.tui.console.model import GraphInfo
from bot_console.tui.panes.graph.namespaces import SPACE, is_link

FIELDS = ("node:", "topic:")
Term = NodeTerm | TextTerm


def items_passing(ids: set[str], edges: Sequence[tuple[str, str]], query: Query, *, both_ends: bool) -> set[str]:
    """The items that pass, with the items linked to them; an excluding word removes the nodes and topics it matches.

    Each word has to match a part of a connection: `navigator scan` finds the navigator's topics with `scan` in their
    names. With `both_ends`, a connection is a topic with a publisher and a subscriber, otherwise with one of them.
    """
    if not query.terms:
        return ids
    excluding, positive = query.part(exclude=True), query.part(exclude=False).terms
    allowed = {each for each in ids if matches(each, excluding)}
    passing = {term: {each for each in allowed if term_matches(term, each)} for term in set(positive)}
    found = {each for each in allowed if all(each in passing[term] for term in positive)}
    known = [(a, b) for a, b in edges if a in allowed and b in allowed]
    if positive:
        for parts in _triples(known) if both_ends else known:
            if all(any(each in passing[term] for each in parts) for term in positive):
                found.update(parts)
    return found


def _triples(edges: Iterable[tuple[str, str]]) -> Iterable[tuple[str, ...]]:
    """Each topic with each pair of a publisher and a subscriber; if it lacks either, with each node that it has."""
    sources: dict[str, list[str]] = {}
    targets: dict[str, list[str]] = {}
    for a, b in edges:
        if is_link(b):
            sources.setdefault(b, []).append(a)
        else:
            targets.setdefault(a, []).append(b)
    for link in sources.keys() | targets.keys():
        givers, takers = sources.get(link, []), targets.get(link, [])
        if givers and takers:
            yield from ((a, link, b) for a, b in product(givers, takers))
        else:
            yield from ((link, each) for each in givers or takers)


def matches(item: str, query: Query) -> bool:
    """Whether a node or a topic passes a filter by its own name."""
    return all(term_matches(term, item) is not term.exclude for term in query.terms)


def term_matches(term: Term, item: str) -> bool:
    """Whether a filter word matches the name of an item."""
    if is_link(item):
        return isinstance(term, TextTerm) and Query.found(term, item.partition(":")[2], "")
    name = item.removeprefix(SPACE)
    if isinstance(term, NodeTerm):
        return term.stands_in(name)
    return term.name is not None and term.name.stands_in(name)


def complete_word(text: str, info: GraphInfo) -> str:
    """The text with its last word completed to the first field or name that begins with it; empty without one."""
    word = text.rpartition(" ")[2].lstrip("!")
    field = next((each for each in FIELDS if word.startswith(each)), "")
    begun = word.removeprefix(field).rpartition("|")[2].removeprefix("=")
    if not begun:
        return ""
    nodes = [] if field == "topic:" else [each.name for each in info.nodes]
    topics = [] if field == "node:" else [each.name for each in info.topics]
    names = sorted({*nodes, *topics})
    fields = () if field or "|" in word else FIELDS
    for each in (*fields, *names, *(name.lstrip("/") for name in names), *(name.rpartition("/")[2] for name in names)):
        if each.lower().startswith(begun.lower()) and len(each) > len(begun):
            return text + each[len(begun) :]
    return ""
