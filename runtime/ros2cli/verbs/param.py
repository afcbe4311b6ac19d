"""`ros2 param`: list, get, set, delete, describe, dump and load."""

from __future__ import annotations

import argparse
from typing import Any

from ros2cli.command import Command, Verb
from ros2cli.direct_node import add_strategy_arguments
from ros2cli.verbs import param_change, param_show


def _common(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--include-hidden-nodes", action="store_true", help="Consider hidden nodes as well")


def _timeout(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--timeout",
        metavar="N",
        type=float,
        default=1,
        help="Wait for N seconds until node becomes available (default 1 sec)",
    )


def _node_arguments(*names: tuple[str, str], middle: Any = None) -> Any:
    """Return a function that adds the arguments of a verb about one node: the shared options around the verb's own."""

    def add(parser: argparse.ArgumentParser) -> None:
        add_strategy_arguments(parser)
        _common(parser)
        parser.add_argument("node_name", help="Name of the ROS node")
        for name, text in names:
            parser.add_argument(name, help=text)
        if middle:
            middle(parser)
        _timeout(parser)

    return add


def _hide_type(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--hide-type", action="store_true", help="Hide the type information")


def _names(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("parameter_names", nargs="+", help="Names of the parameters")


def _wildcard(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--no-use-wildcard",
        action="store_true",
        help="Do not load parameters in the '/**' namespace into the node",
    )


def _list_arguments(parser: argparse.ArgumentParser) -> None:
    add_strategy_arguments(parser)
    parser.add_argument("node_name", nargs="?", help="Name of the ROS node")
    _common(parser)
    parser.add_argument(
        "--param-prefixes", nargs="+", default=[], help="Only list parameters with the provided prefixes"
    )
    parser.add_argument("--param-type", action="store_true", help="Print parameter types with parameter names")
    parser.add_argument("--filter", help="Only list parameters whose name matches the provided regex")
    _timeout(parser)


PARAMETER = ("parameter_name", "Name of the parameter")

COMMAND = Command(
    "param",
    "Various param related sub-commands",
    (
        Verb("delete", "Delete parameter", param_change.delete, _node_arguments(PARAMETER)),
        Verb(
            "describe",
            "Show descriptive information about declared parameters",
            param_show.describe,
            _node_arguments(middle=_names),
        ),
        Verb("dump", "Show all of the parameters of a node in a YAML file format", param_show.dump, _node_arguments()),
        Verb("get", "Get parameter", param_show.get, _node_arguments(PARAMETER, middle=_hide_type)),
        Verb("list", "Output a list of available parameters", param_show.list_, _list_arguments),
        Verb(
            "load",
            "Load parameter file for a node",
            param_change.load,
            _node_arguments(("parameter_file", "Parameter file"), middle=_wildcard),
        ),
        Verb(
            "set", "Set parameter", param_change.set_, _node_arguments(PARAMETER, ("value", "Value of the parameter"))
        ),
    ),
)
