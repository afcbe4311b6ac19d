"""`ros2 node list` and `ros2 node info`."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from typing import Any

from rclpy.node import Node
from ros2cli.advice import advise, no_node
from ros2cli.command import Command, Result, Verb
from ros2cli.direct_node import DirectNode, NodeName, add_strategy_arguments, node_names
from ros2cli.names_and_types import action_names_and_types, add_count_argument, visible_rows

DUPLICATES = (
    "WARNING: Be aware that there are nodes in the graph that share an exact name, "
    "which can have unintended side effects."
)


def _list_arguments(parser: argparse.ArgumentParser) -> None:
    add_strategy_arguments(parser)
    parser.add_argument("-a", "--all", action="store_true", help="Display all nodes even hidden ones")
    add_count_argument("nodes", parser)


def _list(arguments: argparse.Namespace) -> Result:
    with DirectNode(arguments) as node:
        names = [each.full_name for each in node_names(node, include_hidden=arguments.all)]
    if arguments.count_nodes:
        print(len(names))
        return None
    if len(set(names)) < len(names):
        print(DUPLICATES, file=sys.stderr)
    for name in sorted(names):
        print(name)
    return None


def _info_arguments(parser: argparse.ArgumentParser) -> None:
    add_strategy_arguments(parser)
    parser.add_argument("node_name", help="Node name to request information")
    parser.add_argument(
        "--include-hidden", action="store_true", help="Display hidden topics, services, and actions as well"
    )


def _info(arguments: argparse.Namespace) -> Result:
    with DirectNode(arguments) as node:
        names = node_names(node, include_hidden=arguments.include_hidden)
        found = [each for each in names if each.full_name == arguments.node_name]
        if not found:
            advise(lambda: no_node(arguments.node_name, sorted({each.full_name for each in names})))
            return f"Unable to find node '{arguments.node_name}'"
        if len(found) > 1:
            print(
                f'There are {len(found)} nodes in the graph with the exact name "{arguments.node_name}". '
                "You are seeing information about only one of them.",
                file=sys.stderr,
            )
        print(arguments.node_name)
        for title, rows in _sections(node, found[0], arguments.include_hidden):
            print(f"  {title}:")
            print("\n".join(f"    {name}: {', '.join(types)}" for name, types in rows))
    return None


def _sections(node: Node, name: NodeName, hidden: bool) -> Sequence[tuple[str, Any]]:
    who = (name.name, name.namespace)
    publishers = node.get_publisher_names_and_types_by_node(*who)
    subscribers = node.get_subscriber_names_and_types_by_node(*who)
    servers = node.get_service_names_and_types_by_node(*who)
    clients = node.get_client_names_and_types_by_node(*who)
    return (
        ("Subscribers", visible_rows(subscribers, hidden)),
        ("Publishers", visible_rows(publishers, hidden)),
        ("Service Servers", visible_rows(servers, hidden)),
        ("Service Clients", visible_rows(clients, hidden)),
        ("Action Servers", action_names_and_types(servers)),
        ("Action Clients", action_names_and_types(clients)),
    )


COMMAND = Command(
    "node",
    "Various node related sub-commands",
    (
        Verb("info", "Output information about a node", _info, _info_arguments),
        Verb("list", "Output a list of available nodes", _list, _list_arguments),
    ),
)
