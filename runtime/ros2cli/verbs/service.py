"""`ros2 service`: list, type, find, info and call; echo has a file of its own."""

from __future__ import annotations

import argparse
import importlib
import sys
from functools import partial
from typing import Any

from rclpy.clock import Clock, ClockType
from rclpy.duration import Duration
from rclpy.node import Node
from ros2cli.command import Command, Result, Verb
from ros2cli.direct_node import DirectNode, add_strategy_arguments, answer, node_names, spin_until
from ros2cli.names_and_types import (
    add_count_argument,
    add_hidden_argument,
    print_found,
    print_names,
    print_types,
    repeat_hidden_argument,
    visible_rows,
)
from ros2cli.type_discovery import class_of_typed_name, full_type_name
from ros2cli.verbs import service_echo
from ros2cli.verbs.topic_pub import POSITIVE_FLOAT
from ros2cli.yaml_values import fill_message, read_values

_hidden_as_well = partial(repeat_hidden_argument, "services")


def _list_arguments(parser: argparse.ArgumentParser) -> None:
    add_strategy_arguments(parser)
    parser.add_argument("-t", "--show-types", action="store_true", help="Additionally show the service type")
    add_count_argument("services", parser)
    _hidden_as_well(parser)


def _list(arguments: argparse.Namespace) -> Result:
    with DirectNode(arguments) as node:
        rows = visible_rows(node.get_service_names_and_types(), arguments.include_hidden_services)
    if arguments.count_services:
        print(len(rows))
    else:
        print_names(rows, arguments.show_types)
    return None


def _name_arguments(parser: argparse.ArgumentParser) -> None:
    add_strategy_arguments(parser)
    parser.add_argument("service_name", help="Name of the ROS service (e.g. '/talker/list_parameters')")
    _hidden_as_well(parser)


def _info_arguments(parser: argparse.ArgumentParser) -> None:
    add_strategy_arguments(parser)
    parser.add_argument("service_name", help="Name of the ROS service to get info (e.g. '/add_two_ints')")


def _type(arguments: argparse.Namespace) -> Result:
    with DirectNode(arguments) as node:
        rows = visible_rows(node.get_service_names_and_types(), arguments.include_hidden_services)
    return print_types(rows, arguments.service_name)


def _info(arguments: argparse.Namespace) -> Result:
    name = arguments.service_name
    with DirectNode(arguments) as node:
        types = dict(visible_rows(node.get_service_names_and_types(), arguments.include_hidden_services)).get(name)
        if types is None:
            return f"Unknown service '{name}'"
        clients = servers = 0
        for each in node_names(node, include_hidden=True):
            who = (each.name, each.namespace)
            clients += name in dict(node.get_client_names_and_types_by_node(*who))
            servers += name in dict(node.get_service_names_and_types_by_node(*who))
    print(f"Type: {types[0] if len(types) == 1 else types}")
    print(f"Clients count: {clients}")
    print(f"Services count: {servers}")
    return None


def _find_arguments(parser: argparse.ArgumentParser) -> None:
    add_strategy_arguments(parser)
    parser.add_argument("service_type", help="Name of the ROS service type to filter for (e.g. 'std_srvs/srv/Empty')")
    add_count_argument("services", parser)
    _hidden_as_well(parser)


def _find(arguments: argparse.Namespace) -> Result:
    with DirectNode(arguments) as node:
        rows = visible_rows(node.get_service_names_and_types(), arguments.include_hidden_services)
    return print_found(rows, arguments.service_type, arguments.count_services)


def _call_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("service_name", help="Name of the ROS service to call to (e.g. '/add_two_ints')")
    parser.add_argument("service_type", help="Type of the ROS service (e.g. 'std_srvs/srv/Empty')")
    parser.add_argument(
        "values",
        nargs="?",
        default="{}",
        help="Values to fill the service request with in YAML format (e.g. '{a: 1, b: 2}'), otherwise the service "
        "request will be published with default values",
    )
    parser.add_argument("--stdin", action="store_true", help="Read values from standard input")
    parser.add_argument(
        "-r", "--rate", metavar="N", type=POSITIVE_FLOAT, help="Repeat the call at a specific rate in Hz"
    )


def _call(arguments: argparse.Namespace) -> Result:
    kind = class_of_typed_name(_interface, "srv", arguments.service_type, "The passed service type is invalid")
    if isinstance(kind, str):
        return kind
    if not hasattr(kind, "Request"):
        return "The passed type is not a service"
    values = read_values(sys.stdin if arguments.stdin else arguments.values)
    arguments.no_daemon = True
    package, *_, name = arguments.service_type.split("/")
    with DirectNode(arguments, name=f"_ros2cli_requester_{package}_{name}") as node:
        return _requests(node, kind, values, arguments)


def _interface(type_name: str) -> Any:
    """Return the interface class with that type name, which need not be a service."""
    *modules, name = full_type_name("srv", type_name).split("/")
    return getattr(importlib.import_module(".".join(modules)), name)


def _requests(node: Node, kind: Any, values: Any, arguments: argparse.Namespace) -> Result:
    client = node.create_client(kind, arguments.service_name)
    request = kind.Request()
    try:
        fill_message(request, values)
    except Exception as error:  # a field may raise any exception about a value; upstream also catches all
        return f"Failed to populate field: {error}"
    if not client.service_is_ready():
        print("waiting for service to become available...")
        spin_until(node, client.service_is_ready)
    clock = Clock(clock_type=ClockType.STEADY_TIME)
    while True:
        print(f"requester: making request: {request!r}\n")
        future = client.call_async(request)
        print(f"response:\n{answer(node, client, future)!r}\n")
        if arguments.rate is None:
            return None
        clock.sleep_for(Duration(seconds=1.0 / arguments.rate))


COMMAND = Command(
    "service",
    "Various service related sub-commands",
    (
        Verb("call", "Call a service", _call, _call_arguments),
        Verb("echo", "Echo a service", service_echo.echo, service_echo.arguments),
        Verb("find", "Output a list of available services of a given type", _find, _find_arguments),
        Verb("info", "Print information about a service", _info, _info_arguments),
        Verb("list", "Output a list of available services", _list, _list_arguments),
        Verb("type", "Output a service's type", _type, _name_arguments),
    ),
    partial(add_hidden_argument, "services"),
)
