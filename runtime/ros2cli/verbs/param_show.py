"""The verbs of `ros2 param` that only read parameters."""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Sequence
from typing import Any, cast

from bot_console.runtime.rmw.parameter_types import BY_CODE, NOT_SET, ParameterType
from rcl_interfaces.msg import ParameterValue
from rcl_interfaces.srv import DescribeParameters, GetParameters, ListParameters
from rclpy.node import Node
from rclpy.parameter import parameter_value_to_python
from ros2cli.advice import advise, no_node, no_parameter
from ros2cli.command import Result
from ros2cli.direct_node import DirectNode, NoAnswer, NodeName, absolute_name, call, node_names, wait_for_node

NOT_FOUND = "Node not found"
TYPE_WORDS = {NOT_SET: "not set", **{code: each.shown for code, each in BY_CODE.items()}}


def find_node(node: Node, arguments: argparse.Namespace) -> bool:
    """Return whether the node exists, or appears within the time-out; a person gets a hint if not."""
    name = absolute_name(arguments.node_name)
    hidden = arguments.include_hidden_nodes
    if wait_for_node(node, name, include_hidden=hidden, timeout=arguments.timeout):
        return True
    advise(lambda: no_node(name, sorted({each.full_name for each in node_names(node, include_hidden=hidden)})))
    return False


def values_of(node: Node, name: str, parameters: list[str]) -> list[ParameterValue]:
    """Return the values from the node's service; empty if any parameter is undeclared or unset."""
    request = GetParameters.Request(names=parameters)
    return list(call(node, GetParameters, f"{name}/get_parameters", request).values)


def get(arguments: argparse.Namespace) -> Result:
    """`ros2 param get`."""
    name = absolute_name(arguments.node_name)
    with DirectNode(arguments) as node:
        if not find_node(node, arguments):
            return NOT_FOUND
        values = values_of(node, name, [arguments.parameter_name])
        if not values:
            warn("Parameter not set")
            report_missing(node, name, [arguments.parameter_name])
            return 1
    value = values[0]
    if value.type == NOT_SET:
        print("Parameter not set.")
        return None
    kind = BY_CODE.get(value.type)
    if kind is None:
        return f"Unknown parameter type '{value.type}'"
    text = _shown(value, kind)
    print(text if arguments.hide_type else f"{_label(kind)} {text}")
    return None


def _label(kind: ParameterType) -> str:
    word = kind.shown.removesuffix(" array").capitalize()
    return f"{word} values are:" if kind.is_array else f"{word} value is:"


def _shown(value: ParameterValue, kind: ParameterType) -> Any:
    """Return the message field that holds the value, with arrays as lists."""
    shown = getattr(value, kind.field)
    return shown.tolist() if hasattr(shown, "tolist") else shown


def describe(arguments: argparse.Namespace) -> Result:
    """`ros2 param describe`."""
    name = absolute_name(arguments.node_name)
    with DirectNode(arguments) as node:
        if not find_node(node, arguments):
            return NOT_FOUND
        request = DescribeParameters.Request(names=arguments.parameter_names)
        described = call(node, DescribeParameters, f"{name}/describe_parameters", request).descriptors
        for each in described:
            _print_descriptor(each)
        if not described:
            report_missing(node, name, arguments.parameter_names)
    return None


def report_missing(node: Node, name: str, parameters: Sequence[str]) -> None:
    """On a terminal, hint which parameters the node with that full name lacks; upstream then prints nothing."""

    def text() -> str:
        known = call(node, ListParameters, f"{name}/list_parameters", ListParameters.Request()).result.names
        return "\n".join(no_parameter(name, each, known) for each in parameters if each not in known)

    advise(text)


def _print_descriptor(descriptor: Any) -> None:
    print(f"Parameter name: {descriptor.name}")
    print(f"  Type: {TYPE_WORDS.get(descriptor.type, descriptor.type)}")
    if descriptor.description:
        print(f"  Description: {descriptor.description}")
    print("  Constraints:")
    if descriptor.read_only:
        print("    Read only: true")
    for limits in (descriptor.integer_range, descriptor.floating_point_range):
        if len(limits):
            print(f"    Min value: {limits[0].from_value}")
            print(f"    Max value: {limits[0].to_value}")
            if limits[0].step:
                print(f"    Step: {limits[0].step}")
    if descriptor.additional_constraints:
        print(f"    Additional constraints: {descriptor.additional_constraints}")


def list_(arguments: argparse.Namespace) -> Result:
    """`ros2 param list`."""
    pattern = re.compile(arguments.filter) if arguments.filter else None
    with DirectNode(arguments) as node:
        names = sorted(node_names(node, include_hidden=arguments.include_hidden_nodes))
        if arguments.node_name:
            if not find_node(node, arguments):
                return NOT_FOUND
            wanted = absolute_name(arguments.node_name)
            names = [each for each in node_names(node, include_hidden=True) if each.full_name == wanted][:1]
        services = dict(node.get_service_names_and_types())
        for each in names:
            if f"{each.full_name}/list_parameters" not in services:
                continue
            if not arguments.node_name:
                print(f"{each.full_name}:")
            try:
                _print_names(node, each, arguments, pattern)
            except NoAnswer as error:
                if arguments.node_name:
                    raise
                warn(str(error))
    return None


def _print_names(node: Node, name: NodeName, arguments: argparse.Namespace, pattern: re.Pattern[str] | None) -> None:
    request = ListParameters.Request(prefixes=arguments.param_prefixes)
    listed = call(node, ListParameters, f"{name.full_name}/list_parameters", request).result.names
    names = sorted(each for each in listed if pattern is None or pattern.search(each))
    types: dict[str, int] = {}
    if arguments.param_type and names:
        request = DescribeParameters.Request(names=names)
        described = call(node, DescribeParameters, f"{name.full_name}/describe_parameters", request)
        types = {each.name: each.type for each in described.descriptors}
    for each in names:
        print(f"  {each} (type: {TYPE_WORDS[types[each]]})" if each in types else f"  {each}")


def dump(arguments: argparse.Namespace) -> Result:
    """`ros2 param dump`."""
    import yaml

    name = absolute_name(arguments.node_name)
    with DirectNode(arguments) as node:
        if not find_node(node, arguments):
            return NOT_FOUND
        listed = call(node, ListParameters, f"{name}/list_parameters", ListParameters.Request())
        parameters: dict[str, Any] = {}
        for each in sorted(listed.result.names):
            values = values_of(node, name, [each])
            _insert(parameters, each.split("."), parameter_value_to_python(values[0]) if values else None)
    print(yaml.dump({name: {"ros__parameters": parameters}}, default_flow_style=False))
    return None


def _insert(tree: dict[str, Any], path: list[str], value: object) -> None:
    """Insert a value under nested keys; where a prefix is a parameter itself, the rest of the name keeps its dots."""
    *above, last = path
    for depth, key in enumerate(above):
        below = tree.setdefault(key, {})
        if not isinstance(below, dict):
            tree[".".join(path[depth:])] = value
            return
        tree = cast("dict[str, Any]", below)
    tree[last] = value


def warn(text: str) -> None:
    """Print to stderr; for failures that leave the exit code at 0."""
    print(text, file=sys.stderr)
