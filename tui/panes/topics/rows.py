"""Topics, services and actions as rows. Pure."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, replace
from enum import Enum

from bot_console.tui.console.model import Endpoint, GraphInfo, IncompatiblePair, NodeInfo
from bot_console.tui.console.query import Query
from bot_console.tui.console.topics.port import Payload
from bot_console.tui.text.namespaces import outermost
from bot_console.tui.text.natural import natural_key

OWN = "/_bot_console"
"""How the names of the console's nodes begin, which listen so that something can be shown: none of the system."""

BUILT_IN = (
    "/describe_parameters", "/get_parameter_types", "/get_parameters", "/list_parameters", "/set_parameters",
    "/set_parameters_atomically", "/get_type_description", "/get_logger_levels", "/set_logger_levels",
)  # fmt: skip
"""How the names of the services end that every node has."""


class Kind(Enum):
    """The kinds of things that are listed."""

    TOPICS = "topics"
    SERVICES = "services"
    ACTIONS = "actions"

    @property
    def payload(self) -> Payload:
        """The form for one of them."""
        return {Kind.TOPICS: Payload.MESSAGE, Kind.SERVICES: Payload.REQUEST, Kind.ACTIONS: Payload.GOAL}[self]


@dataclass(frozen=True)
class Row:
    """A topic, service or action: its types, and who gives and takes (publishers and subscribers, or servers and
    clients).
    """

    name: str
    types: tuple[str, ...] = ()
    gives: tuple[str, ...] = ()
    takes: tuple[str, ...] = ()
    qos: str = ""
    """The offered QoS; of several different ones the first, and a plus."""
    problem: str = ""
    """The problem with it, in words."""
    space: str = ""
    """The namespace below which it is listed; empty: none."""
    members: tuple[str, ...] = ()
    """The names in it, if the row is a namespace."""
    is_folded: bool = False
    """Whether those are not listed."""

    @property
    def type(self) -> str:
        """The type that counts."""
        return self.types[0] if self.types else ""

    @property
    def label(self) -> str:
        """The visible part of its name: below a namespace the rest of it."""
        return self.name.removeprefix(f"{self.space}/") if self.space else self.name


class _Endpoints:
    """The endpoints found under one name."""

    def __init__(self) -> None:
        self.types: dict[str, None] = {}
        self.gives: list[tuple[str, str]] = []
        self.takes: list[tuple[str, str]] = []
        self.own = False


def rows(info: GraphInfo, kind: Kind, *, hidden: bool) -> list[Row]:
    """The rows of a kind, by name; hidden and built-in ones only where asked for."""
    found: dict[str, _Endpoints] = {}
    for node in info.nodes:
        gives, takes = _ends(node, kind)
        for ends, giving in ((gives, True), (takes, False)):
            for each in ends:
                _take(found.setdefault(each.name, _Endpoints()), node.name, each, giving)
    for each in {Kind.TOPICS: info.topics, Kind.SERVICES: info.services, Kind.ACTIONS: ()}[kind]:
        one = found.setdefault(each.name, _Endpoints())
        one.types.update(dict.fromkeys(each.types))
    made = (
        _row(name, each, kind, info.incompatible.get(name, ()) if kind is Kind.TOPICS else ())
        for name, each in sorted(found.items(), key=lambda each: natural_key(each[0]))
        if each.gives or each.takes or not each.own
    )
    return [row for row in made if hidden or not is_built_in(row.name, kind)]


def _take(found: _Endpoints, node: str, end: Endpoint, giving: bool) -> None:
    if node.startswith(OWN):
        found.own = True
        return
    found.types.update(dict.fromkeys(end.types))
    (found.gives if giving else found.takes).append((node, end.qos))


def _ends(node: NodeInfo, kind: Kind) -> tuple[Iterable[Endpoint], Iterable[Endpoint]]:
    if kind is Kind.TOPICS:
        return node.publishers, node.subscriptions
    if kind is Kind.SERVICES:
        return node.services, node.clients
    return node.action_servers, node.action_clients


def is_built_in(name: str, kind: Kind) -> bool:
    """Whether it is one of those that every node has, or hidden."""
    return "/_" in name or (kind is Kind.SERVICES and name.endswith(BUILT_IN))


def _row(name: str, found: _Endpoints, kind: Kind, broken: Sequence[IncompatiblePair]) -> Row:
    offers = list(dict.fromkeys(qos for _, qos in found.gives if qos))
    qos = offers[0] + ("  +" if len(offers) > 1 else "") if offers else ""
    gives, takes = (tuple(node for node, _ in ends) for ends in (found.gives, found.takes))
    return Row(name, tuple(found.types), gives, takes, qos, _problem(found, kind, broken))


def _problem(found: _Endpoints, kind: Kind, broken: Sequence[IncompatiblePair]) -> str:
    if len(found.types) > 1:
        return f"different types, which do not connect: {', '.join(found.types)}"
    for publisher, subscription, why in broken:
        return f"nothing arrives from {publisher} at {subscription}: {why}"
    if found.takes and not found.gives:
        return "nobody publishes it: is the name right?" if kind is Kind.TOPICS else "no server: calls get no answer"
    return ""


MAX_OPEN_ROWS = 40
"""Rows of a list that starts open; with more of them its namespaces start folded."""


def folds_at_start(every: Sequence[Row]) -> frozenset[str]:
    """The namespaces that are folded in a list that nobody has folded or opened yet."""
    return outermost(each.name for each in every) if len(every) > MAX_OPEN_ROWS else frozenset()


def grouped(every: Sequence[Row], folded: Collection[str]) -> list[Row]:
    """The rows with one before those of each namespace with several of them, and without those of a folded one."""
    spaces = outermost(each.name for each in every)
    inside: dict[str, list[Row]] = {}
    listed: list[Row | str] = []
    for row in every:
        space = next((each for each in spaces if row.name.startswith(f"{each}/")), "")
        if not space:
            listed.append(row)
            continue
        if space not in inside:
            listed.append(space)
        inside.setdefault(space, []).append(row)
    found: list[Row] = []
    for each in listed:
        found += _namespace(each, inside[each], each in folded) if isinstance(each, str) else [each]
    return found


def _namespace(space: str, rows: Sequence[Row], is_folded: bool) -> list[Row]:
    problem = next((f"{each.name}: {each.problem}" for each in rows if each.problem), "") if is_folded else ""
    head = Row(space, problem=problem, members=tuple(each.name for each in rows), is_folded=is_folded)
    return [head] if is_folded else [head, *(replace(each, space=space) for each in rows)]


def matches(query: Query, row: Row) -> bool:
    """Whether a filter lets a row through, by its name, its types or one of its nodes."""
    if not query.terms:
        return True
    nodes = row.gives + row.takes
    text = f"{row.name} {' '.join(row.types)}"
    return any(query.matches(text, node) for node in nodes) if nodes else query.matches(text)
