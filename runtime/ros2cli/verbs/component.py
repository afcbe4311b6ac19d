"""`ros2 component`: list, load, types and unload."""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from ament_index_python import get_packages_with_prefixes, get_resource, get_resources, has_resource
from composition_interfaces.srv import ListNodes, LoadNode, UnloadNode
from rcl_interfaces.msg import Parameter
from rclpy.node import Node
from rclpy.parameter import get_parameter_value
from ros2cli.command import Command, Result, Verb
from ros2cli.direct_node import DirectNode, add_strategy_arguments, call, node_names

if TYPE_CHECKING:
    from bot_console.runtime.rosidl.message import Message, ServiceType

RESOURCE = "rclcpp_components"
"""The kind of resource in which packages list their components."""
ANSWER_TIMEOUT_S = 5.0
"""How long to wait for the service of a container, in seconds."""
SERVICES = {"load_node": "LoadNode", "unload_node": "UnloadNode", "list_nodes": "ListNodes"}


def _containers(node: Node) -> list[str]:
    """Return the nodes that offer the services of a component container."""
    services = dict(node.get_service_names_and_types())

    def offers_all(name: str) -> bool:
        return all(
            f"composition_interfaces/srv/{kind}" in services.get(f"{name}/_container/{service}", ())
            for service, kind in SERVICES.items()
        )

    return sorted(filter(offers_all, (each.full_name for each in node_names(node))))


def _missing(name: str) -> str:
    return f"Unable to find container node '{name}'"


def _list_arguments(parser: argparse.ArgumentParser) -> None:
    add_strategy_arguments(parser)
    parser.add_argument("container_node_name", nargs="?", help="Name of the container node to list components from")
    parser.add_argument("--containers-only", action="store_true", help="List found containers nodes only")


def _list(arguments: argparse.Namespace) -> Result:
    with DirectNode(arguments) as node:
        names = _containers(node)
        wanted = arguments.container_node_name
        if wanted is not None and wanted not in names:
            return _missing(wanted)
        for name in names if wanted is None else [wanted]:
            if wanted is None:
                print(name)
            if arguments.containers_only:
                continue
            found = call(node, ListNodes, f"{name}/_container/list_nodes", ListNodes.Request())
            for uid, component in zip(found.unique_ids, found.full_node_names, strict=True):
                print(f"{'' if wanted else '  '}{uid}  {component}")
    return None


def _load_arguments(parser: argparse.ArgumentParser) -> None:
    add_strategy_arguments(parser)
    add = parser.add_argument
    add("container_node_name", help="Container node name to load component into")
    add("package_name", help="Name of the package where the component is to be found")
    add("plugin_name", help="Type name of the component to be loaded")
    add("-q", "--quiet", action="store_true", help="Only print component unique ID")
    add("-n", "--node-name", default="", help="Component node name")
    add("--node-namespace", default="", help="Component node namespace")
    add("--log-level", help="Component node log level")
    for option, target, text in (
        (("-r", "--remap-rule"), "remap_rules", "Component node remapping rules, in the 'from:=to' form"),
        (("-p", "--parameter"), "parameters", "Component node parameters, in the 'name:=value' form"),
        (("-e", "--extra-argument"), "extra_arguments", "Extra arguments for the container, in the 'name:=value' form"),
    ):
        add(*option, action="append", dest=target, default=[], help=text)


def _load(arguments: argparse.Namespace) -> Result:
    name = arguments.container_node_name
    request = LoadNode.Request(
        package_name=arguments.package_name,
        plugin_name=arguments.plugin_name,
        node_name=arguments.node_name,
        node_namespace=arguments.node_namespace,
        remap_rules=arguments.remap_rules,
        parameters=_parameters(arguments.parameters),
        extra_arguments=_parameters(arguments.extra_arguments),
    )
    if arguments.log_level is not None:
        request.log_level = int(arguments.log_level)
    with DirectNode(arguments) as node:
        if name not in _containers(node):
            return _missing(name)
        loaded = _call(node, LoadNode, name, "load_node", request)
    if not loaded.success:
        return f"Failed to load component: {loaded.error_message.capitalize()}"
    message = f"Loaded component {loaded.unique_id} into '{name}' container node as '{loaded.full_node_name}'"
    print(loaded.unique_id if arguments.quiet else message)
    return None


def _parameters(words: Iterable[str]) -> list[Parameter]:
    pairs = (each.partition(":=") for each in words)
    return [Parameter(name=name, value=get_parameter_value(value)) for name, _, value in pairs]


def _unload_arguments(parser: argparse.ArgumentParser) -> None:
    add_strategy_arguments(parser)
    parser.add_argument("container_node_name", help="Container node name to unload component from")
    parser.add_argument("component_uid", type=int, nargs="+", help="Unique ID of the component to be unloaded")
    parser.add_argument("-q", "--quiet", action="store_true", help="Only print component unique IDs")


def _unload(arguments: argparse.Namespace) -> Result:
    name = arguments.container_node_name
    with DirectNode(arguments) as node:
        if name not in _containers(node):
            return _missing(name)
        for uid in arguments.component_uid:
            unloaded = _call(node, UnloadNode, name, "unload_node", UnloadNode.Request(unique_id=uid))
            if not unloaded.success:
                reason = unloaded.error_message.capitalize()
                return f"Failed to unload component {uid} from '{name}' container node\n    {reason}"
            print(uid if arguments.quiet else f"Unloaded component {uid} from '{name}' container node")
    return None


def _call(node: Node, kind: ServiceType, container: str, service: str, request: Message) -> Any:
    """Return the response of a container's service; raises `RuntimeError` if the service is not ready in time."""
    missing = f"No '{service}' service found for '{container}' container"
    return call(node, kind, f"{container}/_container/{service}", request, ANSWER_TIMEOUT_S, missing)


def _types_arguments(parser: argparse.ArgumentParser) -> None:
    add_strategy_arguments(parser)
    parser.add_argument("package_name", nargs="?", help="Optional package name to narrow down the list")


def _types(arguments: argparse.Namespace) -> Result:
    wanted = arguments.package_name
    if wanted is None:
        for package in get_resources(RESOURCE):
            print(package, *(f"  {each}" for each in _types_of(package)), sep="\n")
    elif wanted in get_packages_with_prefixes():
        print(*_types_of(wanted), sep="\n")
    else:
        return f"Unable to find package '{wanted}'"
    return None


def _types_of(package: str) -> list[str]:
    lines = get_resource(RESOURCE, package)[0].splitlines() if has_resource(RESOURCE, package) else []
    return [each.partition(";")[0] for each in lines]


COMMAND = Command(
    "component",
    "Various component related sub-commands",
    (
        Verb("list", "Output a list of running containers and components", _list, _list_arguments),
        Verb("load", "Load a component into a container node", _load, _load_arguments),
        Verb("types", "Output a list of components registered in the ament index", _types, _types_arguments),
        Verb("unload", "Unload a component from a container node", _unload, _unload_arguments),
    ),
)
