"""The requests that fetch an unknown type from a node; the caller sends them and decides how long to wait."""

from __future__ import annotations

from collections.abc import Generator, Mapping, Sequence
from typing import Any

from bot_console.runtime.interfaces.learned_interfaces import FALSE, UNREADABLE, learn, refusal
from bot_console.runtime.rmw.middleware import bus_of
from bot_console.runtime.rosidl.parse import DefinitionError
from bot_console.runtime.rosidl.received_descriptions import ACTION_TYPES, describe_action, plain_description
from bot_console.runtime.rosidl.type_hash import text_of_description

Question = tuple[str, str]
"""A type and its hash, to be requested from `get_type_description`."""


def containing_action(type_name: str) -> str:
    """Return the action to which a type such as `pkg/action/Name_Feedback` belongs; any other type unchanged."""
    package, kind, name = type_name.split("/")
    return f"{package}/{kind}/{name.partition('_')[0]}" if kind == "action" else type_name


def inquiries(domain: int, type_name: str) -> Mapping[str, Generator[Question, Any, str]]:
    """Return the inquiries for a type, by the nodes of other processes that can be asked, sorted by name."""
    wanted = _types_in_graph(type_name)
    found: dict[str, dict[str, str]] = {}
    for tables in bus_of(domain).tables():
        for each in (*tables.publishers.all(), *tables.subscriptions.all(), *tables.servers.all()):
            if each.type_name in wanted and each.type_hash:
                found.setdefault(each.node.full_name, {})[each.type_name] = each.type_hash
    return {node: inquiry(type_name, hashes) for node, hashes in sorted(found.items()) if len(hashes) == len(wanted)}


def _types_in_graph(type_name: str) -> Sequence[str]:
    """Return the types whose hashes are in the graph: an action's services and feedback, or the type itself."""
    return [f"{type_name}_{part}" for _, part in ACTION_TYPES] if "/action/" in type_name else [type_name]


def inquiry(type_name: str, hashes: Mapping[str, str]) -> Generator[Question, Any, str]:
    """Ask one node: yields requests and receives the responses, after which the type can be imported.

    `hashes` are from the graph: those of the type, or of an action's services and feedback, which determine its own.
    Returns why the type is unavailable, as a sentence whose omitted subject is the node; empty on success.
    """
    if "/action/" not in type_name:
        return learn(type_name, hashes[type_name], (yield type_name, hashes[type_name]))
    parts: list[Any] = []
    for name in _types_in_graph(type_name):
        response = yield name, hashes[name]
        refused = refusal(response)
        if refused:
            return refused
        parts.append(plain_description(response.type_description))
        if text_of_description(parts[-1]) != hashes[name]:
            return f"{FALSE} {hashes[name]}"
    try:
        type_hash = text_of_description(describe_action(type_name, parts))
    except DefinitionError as error:
        return f"{UNREADABLE}: {error}"
    return learn(type_name, type_hash, (yield type_name, type_hash))
