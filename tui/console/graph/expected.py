"""An expected ROS graph in a file: written from a running system, and compared with one.

The file is YAML: `nodes` (names), `topics` (by name: `type`, `publishers`, `subscribers`, `rate` in Hz with a
`tolerance`, `max_age` in s), `services` and `actions` (types by name). The graph may contain more than the file
mentions unless `exact` is set. A ROS parameter file with parameters as in greenwave_monitor is accepted as well.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, cast

import yaml
from bot_console.tui.console.graph.expected_topic import TOLERANCE, ExpectedTopic, deviation, from_parameters
from bot_console.tui.console.model import Endpoint, GraphInfo, NodeInfo
from bot_console.tui.console.parameters.file.text import KEYWORD, sections, value_at
from bot_console.tui.console.topics.port import Measure
from bot_console.tui.files.folders import expanded_path
from bot_console.tui.text.yaml_faults import UNREADABLE, fault_of

PARTS = ("nodes", "topics", "services", "actions", "exact")
ABOUT_TOPIC = ("type", "publishers", "subscribers", "rate", "tolerance", "max_age")
TOOLS = ("/rosout", "/parameter_events")
INFINITE = float("inf")


@dataclass(frozen=True)
class ExpectedGraph:
    """The contents of a file with an expected graph."""

    nodes: frozenset[str] = frozenset()
    topics: Mapping[str, ExpectedTopic] = field(default_factory=lambda: {})
    services: Mapping[str, str] = field(default_factory=lambda: {})
    actions: Mapping[str, str] = field(default_factory=lambda: {})
    exact: bool = False

    @property
    def measured(self) -> dict[str, ExpectedTopic]:
        """The topics whose messages have to be counted."""
        return {name: each for name, each in self.topics.items() if each.is_measured}


def read_file(path: str) -> ExpectedGraph:
    """Read a file with an expected graph; raises `ValueError` with a description of the error."""
    try:
        return read(expanded_path(path).read_text("utf-8"))
    except OSError as error:
        raise ValueError(error.strerror or str(error)) from None
    except UnicodeDecodeError:
        raise ValueError("it is not a text file") from None


def read(text: str) -> ExpectedGraph:
    """Parse the text of such a file; raises `ValueError` with a description of the error."""
    if KEYWORD in text:
        return ExpectedGraph(topics=_parse_parameter_file(text))
    try:
        whole: Any = yaml.safe_load(text)
    except UNREADABLE as error:
        raise ValueError(f"this is not YAML: {fault_of(error)}") from None
    found = _mapping(whole, "the file", PARTS)
    exact = found.get("exact", False)
    if not isinstance(exact, bool):
        raise ValueError(f"exact should be true or false, not '{exact}'")
    return ExpectedGraph(
        _names(found.get("nodes"), "nodes"),
        {_absolute_name(name): _topic(name, each) for name, each in _mapping(found.get("topics"), "topics").items()},
        _types(found.get("services"), "services"),
        _types(found.get("actions"), "actions"),
        exact,
    )


def _parse_parameter_file(text: str) -> dict[str, ExpectedTopic]:
    values = {name: value_at(name, place) for each in sections(text) for name, place in each.places.items()}
    found = from_parameters(values)
    if not found:
        raise ValueError("none of its parameters expects a rate, as topics./scan.expected_frequency does")
    return found


def _mapping(value: Any, what: str, known: tuple[str, ...] = ()) -> Mapping[str, Any]:
    if value is None:
        return {}
    if not isinstance(value, dict):
        raise ValueError(f"{what} should be a mapping, as in 'name: value'")
    found = {str(key): each for key, each in cast("dict[Any, Any]", value).items()}
    unknown = [key for key in found if known and key not in known]
    if unknown:
        raise ValueError(f"'{unknown[0]}' in {what} is unknown; expected one of {', '.join(known)}")
    return found


def _names(value: Any, what: str) -> frozenset[str]:
    words = cast("list[Any]", value) if isinstance(value, list) else None
    if value is not None and (words is None or not all(isinstance(each, str) for each in words)):
        raise ValueError(f"{what} should be a list of names, as in [/a, /b]")
    return frozenset(_absolute_name(each) for each in words or ())


def _absolute_name(name: str) -> str:
    return name if name.startswith("/") else f"/{name}"


def _types(value: Any, what: str) -> dict[str, str]:
    return {_absolute_name(name): str(each) for name, each in _mapping(value, what).items()}


def _topic(name: str, value: Any) -> ExpectedTopic:
    if value is None or isinstance(value, str):
        return ExpectedTopic(type=value)
    found = _mapping(value, name, ABOUT_TOPIC)
    rate, tolerance, age = found.get("rate"), found.get("tolerance", TOLERANCE), found.get("max_age")
    for each in (rate, tolerance, age):
        if each is not None and (
            isinstance(each, bool) or not isinstance(each, (int, float)) or not 0 <= each < INFINITE
        ):
            raise ValueError(f"'{each}' at {name} should be a number, zero or greater")
    ends = [
        _names(found[each], f"{each} of {name}") if each in found else None for each in ("publishers", "subscribers")
    ]
    kind = found.get("type")
    return ExpectedTopic(None if kind is None else str(kind), ends[0], ends[1], rate, float(tolerance), age)


def differences(expected: ExpectedGraph, info: GraphInfo, measured: Mapping[str, Measure] | None = None) -> list[str]:
    """The differences of a graph from the expected one, one line each; rates and ages only with `measured`."""
    nodes = {each.name: each for each in info.nodes if not each.hidden}
    found = [f"node {name} is missing" for name in sorted(expected.nodes - nodes.keys())]
    for name, topic in sorted(expected.topics.items()):
        found += _about_topic(name, topic, list(nodes.values()))
        if measured is not None and (text := deviation(topic, measured.get(name, Measure()))):
            found.append(f"topic {name}: {text}, expected {topic.text}")
    kinds = (("service", expected.services, "services"), ("action", expected.actions, "action_servers"))
    for what, wanted, kind in kinds:
        there = _types_of(list(nodes.values()), kind)
        for name, type_name in sorted(wanted.items()):
            if name not in there:
                found.append(f"{what} {name} is missing")
            elif type_name not in there[name]:
                found.append(f"{what} {name} is of type {', '.join(sorted(there[name]))}, not {type_name}")
    if expected.exact:
        found += [f"node {name} was not expected" for name in sorted(nodes.keys() - expected.nodes)]
        known = expected.topics.keys()
        there = _types_of(list(nodes.values()), "publishers").keys() | _types_of(list(nodes.values()), "subscriptions")
        found += [f"topic {each} was not expected" for each in sorted(there - known) if not _is_tool(each)]
    return found


def _is_tool(topic: str) -> bool:
    return topic in TOOLS or "/_" in topic


def _types_of(nodes: list[NodeInfo], kind: str) -> dict[str, set[str]]:
    found: dict[str, set[str]] = {}
    for node in nodes:
        ends: tuple[Endpoint, ...] = getattr(node, kind)
        for each in ends:
            found.setdefault(each.name, set()).update(each.types)
    return found


def _about_topic(name: str, topic: ExpectedTopic, nodes: list[NodeInfo]) -> list[str]:
    publishers = {node.name for node in nodes for each in node.publishers if each.name == name}
    subscribers = {node.name for node in nodes for each in node.subscriptions if each.name == name}
    if not publishers and not subscribers:
        return [f"topic {name} is missing"]
    types = _types_of(nodes, "publishers").get(name, set()) | _types_of(nodes, "subscriptions").get(name, set())
    found: list[str] = []
    if topic.type is not None and topic.type not in types:
        found.append(f"topic {name} is of type {', '.join(sorted(types))}, not {topic.type}")
    for verb, wanted, there in (
        ("publishes", topic.publishers, publishers),
        ("subscribes to", topic.subscribers, subscribers),
    ):
        if wanted is not None:
            found += [f"{each} no longer {verb} {name}, or not yet" for each in sorted(wanted - there)]
            found += [f"{each} {verb} {name}, which was not expected" for each in sorted(there - wanted)]
    return found


def written(info: GraphInfo, measured: Mapping[str, Measure]) -> str:
    """The text of a file that expects the given graph with its measured rates."""
    nodes = [each for each in info.nodes if not each.hidden]
    topics: dict[str, Any] = {}
    types = {**_types_of(nodes, "subscriptions"), **_types_of(nodes, "publishers")}
    for name in sorted(each for each in types if not _is_tool(each)):
        about: dict[str, Any] = {"type": min(types[name])}
        about["publishers"] = sorted(n.name for n in nodes for each in n.publishers if each.name == name)
        about["subscribers"] = sorted(n.name for n in nodes for each in n.subscriptions if each.name == name)
        rate = measured[name].rate if name in measured else None
        if rate:
            about["rate"] = float(f"{rate:.2g}")
        topics[name] = about
    own = tuple(each.name for each in nodes)
    services = {
        name: min(kinds)
        for name, kinds in sorted(_types_of(nodes, "services").items())
        if "/_" not in name and not name.startswith(tuple(f"{each}/" for each in own))
    }
    actions = {name: min(kinds) for name, kinds in sorted(_types_of(nodes, "action_servers").items())}
    whole = {"nodes": sorted(own), "topics": topics, "services": services, "actions": actions}
    return yaml.safe_dump(whole, sort_keys=False, default_flow_style=None, width=120)
