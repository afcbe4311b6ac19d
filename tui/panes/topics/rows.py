"""Topics, services and actions as rows. Pure."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, replace
from enum import Enum

from bot_console.tui.console.filter_syntax import Query
from bot_console.tui.console.model import Endpoint, GraphInfo, IncompatiblePair, NodeInfo
from bot_console.tui.console.topics.port import Payload
from bot_console.tui.text.namespaces import foldable_namespaces
from bot_console.tui.text.natural import natural_key

OWN = "/_bot_console"
"""Prefix of the console's own nodes, which subscribe only to show something and are not part of the system."""

BUILT_IN = (
    "/describe_parameters", "/get_parameter_types", "/get_parameters", "/list_parameters", "/set_parameters",
    "/set_parameters_atomically", "/get_type_description", "/get_logger_levels", "/set_logger_levels",
)  # fmt: skip
"""Suffixes of the services that every node has."""


class Kind(Enum):
    """What the pane lists."""

    TOPICS = "topics"
    SERVICES = "services"
    ACTIONS = "actions"

    @property
    def payload(self) -> Payload:
        """The payload that is filled in for this kind."""
        return {Kind.TOPICS: Payload.MESSAGE, Kind.SERVICES: Payload.REQUEST, Kind.ACTIONS: Payload.GOAL}[self]


@dataclass(frozen=True)
class Row:
    """A topic, service or action with its types and nodes, or a namespace.

    `gives` are the publishers or servers, `takes` the subscribers or clients.
    """

    name: str
    types: tuple[str, ...] = ()
    gives: tuple[str, ...] = ()
    takes: tuple[str, ...] = ()
    qos: str = ""
    """The offered QoS; if there are different ones, the first with a plus."""
    problem: str = ""
    """A description of what is wrong; empty if nothing is."""
    space: str = ""
    """The namespace row below which it is listed; empty if there is none."""
    members: tuple[str, ...] = ()
    """The names in the namespace, if the row is one."""
    is_folded: bool = False
    """Whether the row is a folded namespace."""

    @property
    def type(self) -> str:
        """The first type; empty if none is known."""
        return self.types[0] if self.types else ""

    @property
    def label(self) -> str:
        """The name as shown: relative to the namespace row above."""
        return self.name.removeprefix(f"{self.space}/") if self.space else self.name


class _Endpoints:
    """The endpoints found under one name."""

    def __init__(self) -> None:
        self.types: dict[str, None] = {}
        self.gives: list[tuple[str, str]] = []
        self.takes: list[tuple[str, str]] = []
        self.own = False


def rows(info: GraphInfo, kind: Kind, *, hidden: bool) -> list[Row]:
    """The rows of a kind in order of name; hidden and built-in ones only if `hidden` is set."""
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
    """Whether a name is hidden, or a service that every node has."""
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
"""Maximum rows of a list that starts unfolded; in a longer one, namespaces start folded."""


def initial_folds(every: Sequence[Row]) -> frozenset[str]:
    """The namespaces that are folded before the user has folded or unfolded anything."""
    return foldable_namespaces(each.name for each in every) if len(every) > MAX_OPEN_ROWS else frozenset()


def group_by_namespace(every: Sequence[Row], folded: Collection[str]) -> list[Row]:
    """Group rows by namespace: each namespace of several rows gets a row above them, and hides them if it is folded."""
    spaces = foldable_namespaces(each.name for each in every)
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
    """Whether a row passes a filter by its name, its types or one of its nodes."""
    if not query.terms:
        return True
    nodes = row.gives + row.takes
    text = f"{row.name} {' '.join(row.types)}"
    return any(query.matches(text, node) for node in nodes) if nodes else query.matches(text)
