"""`ros2 service echo`: prints the requests and responses of a service whose introspection is on."""

from __future__ import annotations

import argparse
from functools import partial
from typing import Any

from rclpy.node import Node
from ros2cli.command import Result
from ros2cli.direct_node import DirectNode, absolute_name, add_strategy_arguments, spin_until
from ros2cli.qos_arguments import add_qos_arguments, profile
from ros2cli.type_discovery import class_of_typed_name
from ros2cli.verbs.topic_echo import add_form_arguments
from rosidl_runtime_py import message_to_csv, message_to_ordereddict
from rosidl_runtime_py.convert import ordereddict_to_yaml
from rosidl_runtime_py.utilities import get_service

EVENT_TOPIC = "/_service_event"
EVENTS = ("REQUEST_SENT", "REQUEST_RECEIVED", "RESPONSE_SENT", "RESPONSE_RECEIVED")
"""The words for `service_msgs/msg/ServiceEventInfo.event_type`."""


def arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the verb."""
    add = parser.add_argument
    add_strategy_arguments(parser)
    add("service_name", help="Name of the ROS service to echo (e.g. '/add_two_ints')")
    add("service_type", nargs="?", help="Type of the ROS service (e.g. 'example_interfaces/srv/AddTwoInts')")
    add_qos_arguments(parser, "subscribe", "services_default")
    add(
        "--csv",
        action="store_true",
        help="Output all recursive fields separated by commas (e.g. for plotting).",
    )
    add_form_arguments(parser)


def echo(arguments: argparse.Namespace) -> Result:
    """`ros2 service echo`."""
    with DirectNode(arguments) as node:
        kind = _service_class(node, arguments)
        if isinstance(kind, str):
            return kind
        qos = profile(arguments, "services_default")
        topic = arguments.service_name + EVENT_TOPIC
        node.create_subscription(kind.Event, topic, partial(_show, arguments), qos)
        spin_until(node, lambda: False)
    return None


def _service_class(node: Node, arguments: argparse.Namespace) -> Any:
    """Return the class of the service, or the reason why it is not available as a string."""
    name = arguments.service_name
    if arguments.service_type is not None:
        invalid = f"The service type '{arguments.service_type}' is invalid"
        return class_of_typed_name(get_service, "srv", arguments.service_type, invalid, node)
    types = dict(node.get_service_names_and_types()).get(absolute_name(name))
    if not types:
        return "Could not load the type for the passed service"
    return class_of_typed_name(get_service, "srv", types[0], f"The service name '{name}' is invalid", node)


def _show(chosen: argparse.Namespace, event: Any) -> None:
    length = None if chosen.full_length else chosen.truncate_length
    shown: dict[str, Any] = {"truncate_length": length, "no_arr": chosen.no_arr, "no_str": chosen.no_str}
    if chosen.csv:
        print(message_to_csv(event, **shown))
        return
    fields = message_to_ordereddict(event, **shown)
    fields["info"]["event_type"] = EVENTS[event.info.event_type]
    print(ordereddict_to_yaml(fields, flow_style=chosen.flow_style), end="---\n")
