"""`ros2 lifecycle`: nodes, get, set and list."""

from __future__ import annotations

import argparse
import sys

from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState, GetAvailableTransitions, GetState
from rclpy.node import Node
from ros2cli.command import Command, Result, Verb
from ros2cli.direct_node import DirectNode, absolute_name, add_strategy_arguments, call, node_names
from ros2cli.names_and_types import add_count_argument

GET_STATE = "lifecycle_msgs/srv/GetState"


def _lifecycle_nodes(node: Node, include_hidden: bool) -> list[str]:
    """Return the lifecycle nodes."""
    services = dict(node.get_service_names_and_types())
    names = sorted(each.full_name for each in node_names(node, include_hidden=include_hidden))
    return [name for name in names if GET_STATE in services.get(f"{name}/get_state", ())]


def _hidden(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--include-hidden-nodes", action="store_true", help="Consider hidden nodes as well")


def _nodes_arguments(parser: argparse.ArgumentParser) -> None:
    add_strategy_arguments(parser)
    parser.add_argument("-a", "--all", action="store_true", help="Display all nodes even hidden ones")
    add_count_argument("nodes", parser)


def _nodes(arguments: argparse.Namespace) -> Result:
    with DirectNode(arguments) as node:
        names = _lifecycle_nodes(node, arguments.all)
    if arguments.count_nodes:
        print(len(names))
    for name in () if arguments.count_nodes else names:
        print(name)
    return None


def _get_arguments(parser: argparse.ArgumentParser) -> None:
    add_strategy_arguments(parser)
    parser.add_argument("node_name", nargs="?", help="Name of the ROS node")
    _hidden(parser)


def _get(arguments: argparse.Namespace) -> Result:
    with DirectNode(arguments) as node:
        names = _lifecycle_nodes(node, arguments.include_hidden_nodes)
        if arguments.node_name:
            if absolute_name(arguments.node_name) not in names:
                return "Node not found"
            names = [absolute_name(arguments.node_name)]
        for name in names:
            state = call(node, GetState, f"{name}/get_state", GetState.Request()).current_state
            text = f"{state.label} [{state.id}]"
            print(text if arguments.node_name else f"{name}: {text}")
    return None


def _set_arguments(parser: argparse.ArgumentParser) -> None:
    add_strategy_arguments(parser)
    parser.add_argument("node_name", help="Name of the ROS node")
    _hidden(parser)
    parser.add_argument("transition", help="The lifecycle transition")


def _set(arguments: argparse.Namespace) -> Result:
    name = absolute_name(arguments.node_name)
    with DirectNode(arguments) as node:
        if name not in _lifecycle_nodes(node, arguments.include_hidden_nodes):
            return "Node not found"
        offered = _transitions(node, name)
        wanted = [each for each in offered if each.label == arguments.transition]
        wanted += [each for each in offered if str(each.id) == arguments.transition]
        if not wanted:
            listing = "".join(f"\n- {each.label} [{each.id}]" for each in offered)
            return f"Unknown transition requested, available ones are:{listing}"
        request = ChangeState.Request(transition=wanted[0])
        if call(node, ChangeState, f"{name}/change_state", request).success:
            print("Transitioning successful")
        else:
            print("Transitioning failed", file=sys.stderr)  # as upstream, the exit code stays 0
    return None


def _transitions(node: Node, name: str) -> list[Transition]:
    request = GetAvailableTransitions.Request()
    service = f"{name}/get_available_transitions"
    return [each.transition for each in call(node, GetAvailableTransitions, service, request).available_transitions]


def _list_arguments(parser: argparse.ArgumentParser) -> None:
    add_strategy_arguments(parser)
    parser.add_argument("node_name", help="Name of the ROS node")
    _hidden(parser)
    parser.add_argument("-a", "--all", action="store_true", help="Display all existing transitions")


def _list(arguments: argparse.Namespace) -> Result:
    name = absolute_name(arguments.node_name)
    with DirectNode(arguments) as node:
        if name not in _lifecycle_nodes(node, arguments.include_hidden_nodes):
            return "Node not found"
        verb = "get_transition_graph" if arguments.all else "get_available_transitions"
        answer = call(node, GetAvailableTransitions, f"{name}/{verb}", GetAvailableTransitions.Request())
    for each in answer.available_transitions:
        print(f"- {each.transition.label} [{each.transition.id}]")
        print(f"\tStart: {each.start_state.label}")
        print(f"\tGoal: {each.goal_state.label}")
    return None


COMMAND = Command(
    "lifecycle",
    "Various lifecycle related sub-commands",
    (
        Verb("get", "Get lifecycle state for one or more nodes", _get, _get_arguments),
        Verb("list", "Output a list of available transitions", _list, _list_arguments),
        Verb("nodes", "Output a list of nodes with lifecycle", _nodes, _nodes_arguments),
        Verb("set", "Trigger lifecycle state transition", _set, _set_arguments),
    ),
)
