"""`ros2 action`: list, info, type and send_goal."""

from __future__ import annotations

import argparse
from typing import Any

from rclpy.node import Node
from ros2cli.command import Command, Result, Verb
from ros2cli.direct_node import DirectNode, add_strategy_arguments, node_names, spin_until
from ros2cli.endpoints import action_names_and_types
from rosidl_runtime_py import message_to_yaml, set_message_fields
from rosidl_runtime_py.utilities import get_action

Sides = dict[str, list[tuple[str, str]]]
"""Nodes and action types by action name."""


def _sides(node: Node) -> tuple[Sides, Sides]:
    """Who serves and who calls each action."""
    servers: Sides = {}
    clients: Sides = {}
    for each in node_names(node, include_hidden=True):
        who = (each.name, each.namespace)
        for side, services in (
            (servers, node.get_service_names_and_types_by_node(*who)),
            (clients, node.get_client_names_and_types_by_node(*who)),
        ):
            for name, types in action_names_and_types(services):
                side.setdefault(name, []).extend((each.full_name, kind) for kind in types)
    return servers, clients


def _types(servers: Sides, clients: Sides) -> dict[str, list[str]]:
    names = sorted({*servers, *clients})
    return {name: sorted({kind for side in (servers, clients) for _, kind in side.get(name, [])}) for name in names}


def _list_arguments(parser: argparse.ArgumentParser) -> None:
    add_strategy_arguments(parser)
    parser.add_argument("-t", "--show-types", action="store_true", help="Additionally show the action type")
    parser.add_argument(
        "-c", "--count-actions", action="store_true", help="Only display the number of actions discovered"
    )


def _list(arguments: argparse.Namespace) -> Result:
    with DirectNode(arguments) as node:
        types = _types(*_sides(node))
    if arguments.count_actions:
        print(len(types))
        return None
    for name, kinds in types.items():
        print(f"{name} [{', '.join(kinds)}]" if arguments.show_types else name)
    return None


def _info_arguments(parser: argparse.ArgumentParser) -> None:
    add_strategy_arguments(parser)
    parser.add_argument("action_name", help="Name of the ROS action to get info (e.g. '/fibonacci')")
    parser.add_argument("-t", "--show-types", action="store_true", help="Additionally show the action type")
    parser.add_argument(
        "-c", "--count", action="store_true", help="Only display the number of action clients and servers"
    )


def _info(arguments: argparse.Namespace) -> Result:
    name = arguments.action_name
    with DirectNode(arguments) as node:
        servers, clients = _sides(node)
    print(f"Action: {name}")
    for title, side in (("Action clients", clients), ("Action servers", servers)):
        rows = side.get(name, [])
        print(f"{title}: {len(rows)}")
        if not arguments.count:
            for full_name, kind in rows:
                print(f"    {full_name} [{kind}]" if arguments.show_types else f"    {full_name}")
    return None


def _type_arguments(parser: argparse.ArgumentParser) -> None:
    add_strategy_arguments(parser)
    parser.add_argument("action_name", help="Name of the ROS action to get type (e.g. '/fibonacci')")


def _type(arguments: argparse.Namespace) -> Result:
    with DirectNode(arguments) as node:
        types = _types(*_sides(node)).get(arguments.action_name)
    if types is None:
        return 1
    for each in types:
        print(each)
    return None


def _goal_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("action_name", help="Name of the ROS action (e.g. '/fibonacci')")
    parser.add_argument("action_type", help="Type of the ROS action (e.g. 'example_interfaces/action/Fibonacci')")
    parser.add_argument("goal", help="Goal request values in YAML format (e.g. '{order: 10}')")
    parser.add_argument("-f", "--feedback", action="store_true", help="Echo feedback messages for the goal")


def _send_goal(arguments: argparse.Namespace) -> Result:
    import yaml
    from rclpy.action import ActionClient

    try:
        kind = get_action(arguments.action_type)
    except (AttributeError, ModuleNotFoundError, ValueError):
        return "The passed action type is invalid"
    values = yaml.safe_load(arguments.goal)
    goal = kind.Goal()
    try:
        set_message_fields(goal, values)
    except (AttributeError, TypeError, ValueError) as error:
        return f"Failed to populate message fields: {error!r}"
    arguments.no_daemon = True
    with DirectNode(arguments) as node:
        return _follow(node, ActionClient(node, kind, arguments.action_name), goal, arguments.feedback)


def _follow(node: Node, client: Any, goal: Any, feedback: bool) -> Result:
    """Send the goal and stay with it to its result; Ctrl-C cancels it."""
    handle: Any = None
    try:
        print("Waiting for an action server to become available...")
        spin_until(node, client.server_is_ready)
        print(f"Sending goal:\n     {message_to_yaml(goal)}")
        show = (lambda message: print(f"Feedback:\n    {message_to_yaml(message.feedback)}")) if feedback else None
        sent = client.send_goal_async(goal, show)
        spin_until(node, sent.done)
        handle = sent.result()
        if not handle.accepted:
            print("Goal was rejected.")
            return None
        print(f"Goal accepted with ID: {bytes(handle.goal_id.uuid).hex()}\n")
        result = handle.get_result_async()
        spin_until(node, result.done)
        answer = result.result()
        handle = None
        print(f"Result:\n    {message_to_yaml(answer.result)}")
        print(f"Goal finished with status: {STATUS.get(answer.status, 'UNKNOWN')}")
        return None
    finally:
        if handle is not None and handle.accepted:
            print("Canceling goal...")
            cancel = handle.cancel_goal_async()
            spin_until(node, cancel.done, 5.0)
            print("Goal canceled.")
        client.destroy()


STATUS = {0: "UNKNOWN", 1: "ACCEPTED", 2: "EXECUTING", 3: "CANCELING", 4: "SUCCEEDED", 5: "CANCELED", 6: "ABORTED"}

COMMAND = Command(
    "action",
    "Various action related sub-commands",
    (
        Verb("info", "Print information about an action", _info, _info_arguments),
        Verb("list", "Output a list of action names", _list, _list_arguments),
        Verb("send_goal", "Send an action goal", _send_goal, _goal_arguments),
        Verb("type", "Print a action's type", _type, _type_arguments),
    ),
)
