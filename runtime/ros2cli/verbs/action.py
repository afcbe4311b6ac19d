"""`ros2 action`: list, info, type and send_goal."""

from __future__ import annotations

import argparse
import signal
import sys
from typing import TYPE_CHECKING, Any

from action_msgs.msg import GoalStatus
from rclpy.action import (
    ActionClient,
    get_action_client_names_and_types_by_node,
    get_action_names_and_types,
    get_action_server_names_and_types_by_node,
)
from rclpy.exceptions import InvalidTopicNameException
from rclpy.expand_topic_name import expand_topic_name
from rclpy.node import Node
from rclpy.signals import uninstall_signal_handlers
from rclpy.validate_full_topic_name import validate_full_topic_name
from ros2cli.command import Command, Result, Verb
from ros2cli.direct_node import (
    SERVER_POLL_S,
    DirectNode,
    NoAnswer,
    Server,
    add_strategy_arguments,
    node_names,
    spin_until,
)
from ros2cli.names_and_types import add_count_argument, print_names, print_types
from ros2cli.type_discovery import class_of_typed_name
from ros2cli.yaml_values import fill_message, read_values
from rosidl_runtime_py import message_to_yaml
from rosidl_runtime_py.utilities import get_action

if TYPE_CHECKING:
    from bot_console.runtime.rosidl.message import Message

Rows = list[tuple[str, list[str]]]
"""Names of nodes or actions, each with the types of an action."""


def _clients_and_servers(node: Node, action: str) -> tuple[Rows, Rows]:
    """Return the clients and servers of an action; `InvalidTopicNameException` or `ValueError` for an invalid name."""
    name = expand_topic_name(action, node.get_name(), node.get_namespace())
    validate_full_topic_name(name)
    sides: tuple[Rows, Rows] = ([], [])
    for each in node_names(node, include_hidden=True):
        clients = get_action_client_names_and_types_by_node(node, each.name, each.namespace)
        servers = get_action_server_names_and_types_by_node(node, each.name, each.namespace)
        for side, actions in zip(sides, (clients, servers), strict=True):
            side.extend((each.full_name, types) for found, types in actions if found == name)
    return sides


def _list_arguments(parser: argparse.ArgumentParser) -> None:
    add_strategy_arguments(parser)
    parser.add_argument("-t", "--show-types", action="store_true", help="Additionally show the action type")
    add_count_argument("actions", parser)


def _list(arguments: argparse.Namespace) -> Result:
    with DirectNode(arguments) as node:
        actions = get_action_names_and_types(node)
    if arguments.count_actions:
        print(len(actions))
    else:
        print_names(actions, arguments.show_types)
    return None


def _info_arguments(parser: argparse.ArgumentParser) -> None:
    add_strategy_arguments(parser)
    parser.add_argument("action_name", help="Name of the ROS action to get info (e.g. '/fibonacci')")
    parser.add_argument("-t", "--show-types", action="store_true", help="Additionally show the action type")
    parser.add_argument(
        "-c", "--count", action="store_true", help="Only display the number of action clients and servers"
    )


def _info(arguments: argparse.Namespace) -> Result:
    with DirectNode(arguments) as node:
        try:
            clients, servers = _clients_and_servers(node, arguments.action_name)
        except (InvalidTopicNameException, ValueError) as error:
            return str(error)
    print(f"Action: {arguments.action_name}")
    for title, rows in (("Action clients", clients), ("Action servers", servers)):
        print(f"{title}: {len(rows)}")
        if not arguments.count:
            for name, types in rows:
                print(f"    {name} [{', '.join(types)}]" if arguments.show_types else f"    {name}")
    return None


def _type_arguments(parser: argparse.ArgumentParser) -> None:
    add_strategy_arguments(parser)
    parser.add_argument("action_name", help="Name of the ROS action to get type (e.g. '/fibonacci')")


def _type(arguments: argparse.Namespace) -> Result:
    with DirectNode(arguments) as node:
        actions = get_action_names_and_types(node)
    return print_types(actions, arguments.action_name)


def _goal_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("action_name", help="Name of the ROS action (e.g. '/fibonacci')")
    parser.add_argument("action_type", help="Type of the ROS action (e.g. 'example_interfaces/action/Fibonacci')")
    group = parser.add_mutually_exclusive_group()
    group.add_argument("goal", nargs="?", default="{}", help="Goal request values in YAML format (e.g. '{order: 10}')")
    group.add_argument("--stdin", action="store_true", help="Read goal from standard input")
    parser.add_argument("-f", "--feedback", action="store_true", help="Echo feedback messages for the goal")


def _send_goal(arguments: argparse.Namespace) -> Result:
    kind = class_of_typed_name(get_action, "action", arguments.action_type, "The passed action type is invalid")
    if isinstance(kind, str):
        return kind
    values = read_values(sys.stdin if arguments.stdin else arguments.goal)
    goal = kind.Goal()
    try:
        fill_message(goal, values)
    except Exception as error:  # a field may raise any exception about a value; upstream also catches all
        return f"Failed to populate message fields: {error!r}"
    arguments.no_daemon = True
    with DirectNode(arguments, name=f"_ros2cli_send_goal_{arguments.action_type.replace('/', '_')}") as node:
        # Ctrl-C must not shut the context down, as the goal has to be cancelled first.
        uninstall_signal_handlers()
        client = ActionClient(node, kind, arguments.action_name)
        try:
            with _Interrupt() as interrupt:
                return _follow(node, client, goal, arguments.feedback, interrupt)
        finally:
            client.destroy()


class _Interrupt:
    """A Ctrl-C that `check` raises, not the line where it arrives: otherwise an answer being taken would be lost."""

    def __init__(self) -> None:
        self.came = False

    def __enter__(self) -> _Interrupt:
        self._before = signal.signal(signal.SIGINT, self._notice)
        return self

    def __exit__(self, *_: object) -> None:
        signal.signal(signal.SIGINT, self._before)

    def _notice(self, signum: int, frame: object) -> None:
        if self.came:
            raise KeyboardInterrupt
        self.came = True

    def check(self) -> None:
        """Raise `KeyboardInterrupt` if Ctrl-C was pressed since the last check."""
        if self.came:
            self.came = False
            raise KeyboardInterrupt


def _follow(node: Node, client: ActionClient, goal: Message, feedback: bool, interrupt: _Interrupt) -> Result:
    """Send the goal and wait for its result; Ctrl-C cancels the goal."""
    print("Waiting for an action server to become available...")
    spin_until(node, lambda: interrupt.came or client.server_is_ready())
    interrupt.check()
    print(f"Sending goal:\n     {message_to_yaml(goal)}")

    def show(message: Any) -> None:
        print(f"Feedback:\n    {message_to_yaml(message.feedback)}")

    handle: Any = _outcome(node, client, client.send_goal_async(goal, show if feedback else None), interrupt)
    if not handle.accepted:
        print("Goal was rejected.")
        return None
    print(f"Goal accepted with ID: {bytes(handle.goal_id.uuid).hex()}\n")
    try:
        answer: Any = _outcome(node, client, handle.get_result_async(), interrupt)
    except KeyboardInterrupt:
        problem = _cancel(node, client, handle, interrupt)
        if problem:
            return problem
        raise
    print(f"Result:\n    {message_to_yaml(answer.result)}")
    print(f"Goal finished with status: {STATUS.get(answer.status, 'UNKNOWN')}")
    return None


def _outcome(node: Node, client: ActionClient, future: Any, interrupt: _Interrupt) -> Any:
    """Wait for the server's part of the work; raises `KeyboardInterrupt` on Ctrl-C.

    Raises `NoAnswer` if the server has left, where upstream would wait for ever.
    """
    endpoints = getattr(client, "_endpoints", None)
    server = Server(node, client.server_is_ready, endpoints and endpoints.goal)
    while not spin_until(node, lambda: interrupt.came or future.done(), SERVER_POLL_S):
        if server.has_gone():
            name = client._action_name  # pyright: ignore[reportPrivateUsage] -- upstream gives it no public name, either
            raise NoAnswer(f"nobody answers {name}: its server has ended since it was asked; see what it printed")
    interrupt.check()
    return future.result()


def _cancel(node: Node, client: ActionClient, handle: Any, interrupt: _Interrupt) -> str | None:
    """Request the cancellation of a goal that has not ended; returns an error message if the server refuses."""
    if handle.status not in (GoalStatus.STATUS_ACCEPTED, GoalStatus.STATUS_EXECUTING):
        return None
    print("Canceling goal...")
    answer = _outcome(node, client, handle.cancel_goal_async(), interrupt)
    cancelling = [bytes(each.goal_id.uuid) for each in answer.goals_canceling]
    if not cancelling:
        return "Failed to cancel goal"
    if len(cancelling) > 1:
        return "More than one goal canceled"
    if cancelling[0] != bytes(handle.goal_id.uuid):
        return "Canceled goal with incorrect goal ID"
    print("Goal canceled.")
    return None


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
