"""`ros2 topic echo`."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from operator import attrgetter
from typing import Any

from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.node import Node
from ros2cli.command import Result
from ros2cli.direct_node import DirectNode, absolute_name, add_strategy_arguments, spin_until
from ros2cli.qos_arguments import add_qos_arguments, compatible_profile
from ros2cli.type_discovery import class_of_typed_name, message_class
from ros2cli.verbs.topic_pub import POSITIVE_FLOAT
from rosidl_runtime_py import message_to_csv, message_to_yaml
from rosidl_runtime_py.utilities import get_message

MAX_SHOWN = 128
"""How many elements or characters are shown by default."""


def unsigned(text: str) -> int:
    """Parse the value of an option as an integer of at least 0."""
    try:
        value = int(text)
    except ValueError:
        value = -1
    if value < 0:
        raise argparse.ArgumentTypeError("value must be an unsigned integer")
    return value


def add_form_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options for the output format and for how much of arrays and strings is shown."""
    parser.add_argument(
        "--full-length",
        "-f",
        action="store_true",
        help="Output all elements for arrays, bytes, and string with a length > '--truncate-length', by default they "
        "are truncated after '--truncate-length' elements with '...''",
    )
    parser.add_argument(
        "--truncate-length",
        "-l",
        type=unsigned,
        default=MAX_SHOWN,
        help=f"The length to truncate arrays, bytes, and string to (default: {MAX_SHOWN})",
    )
    parser.add_argument("--no-arr", action="store_true", help="Don't print array fields of messages")
    parser.add_argument("--no-str", action="store_true", help="Don't print string fields of messages")
    parser.add_argument(
        "--flow-style",
        action="store_true",
        help="Print collections in the block style (not available with csv format)",
    )


def arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the verb."""
    add = parser.add_argument
    add_strategy_arguments(parser)
    add("topic_name", help="Name of the ROS topic to listen to (e.g. '/chatter')")
    add("message_type", nargs="?", help="Type of the ROS message (e.g. 'std_msgs/msg/String')")
    add_qos_arguments(parser, "subscribe", "sensor_data")
    add(
        "--csv",
        action="store_true",
        help="Output all recursive fields separated by commas (e.g. for plotting). If --include-message-info is also "
        "passed, the following fields are prepended: source_timestamp, received_timestamp, "
        "publication_sequence_number, reception_sequence_number.",
    )
    add(
        "--field",
        help="Echo a selected field of a message. Use '.' to select sub-fields. For example, to echo the position "
        "field of a nav_msgs/msg/Odometry message: 'ros2 topic echo /odom --field pose.pose.position'",
    )
    add_form_arguments(parser)
    add("--no-lost-messages", action="store_true", help="Don't report when a message is lost")
    add("--raw", action="store_true", help="Echo the raw binary representation")
    add(
        "--filter",
        dest="filter_expr",
        help="Python expression to filter messages that are printed. Expression can use Python builtins as well as m "
        "(the message).",
    )
    add("--once", action="store_true", help="Print the first message received and then exit.")
    add("--timeout", metavar="N", type=POSITIVE_FLOAT, help="Set a timeout in seconds for waiting")
    add("--include-message-info", "-i", action="store_true", help="Shows the associated message info.")


class _Printer:
    """Prints messages as the options request; `done` becomes true after the last one."""

    def __init__(self, arguments: argparse.Namespace) -> None:
        self._arguments = arguments
        self._limit = None if arguments.full_length else arguments.truncate_length
        self._passes = message_filter(arguments.filter_expr)
        self._field = ".".join(filter(None, (arguments.field or "").split(".")))
        if arguments.field is not None and not self._field:
            raise RuntimeError(f"Invalid field value '{arguments.field}'")
        self.problem = ""
        self.done = False

    def show(self, message: object, info: object) -> None:
        """Print one message, or the selected field of it; the filter applies to what would be printed."""
        chosen = self._arguments
        if self._field:
            try:
                message = attrgetter(self._field)(message)
            except AttributeError as error:
                self.problem = f"Invalid field '{self._field}': {error}"
                self.done = True
                return
        if not self._passes(message):
            return
        if not hasattr(message, "get_fields_and_field_types"):
            self._print_value(message, info)
        elif chosen.csv:
            print(self._csv(message, info))
        else:
            self._print_block(message, info)
        self.done = chosen.once

    def _print_value(self, value: object, info: object) -> None:
        """Print something other than a message, i.e. a field or raw bytes; ignores `--csv`."""
        if self._arguments.include_message_info:
            print(f"---Got new message, message info:---\n{info}\n---Message data:---")
        print(value, end="\n---\n")

    def _csv(self, message: Any, info: Any) -> str:
        chosen = self._arguments
        text = message_to_csv(message, truncate_length=self._limit, no_arr=chosen.no_arr, no_str=chosen.no_str)
        if not chosen.include_message_info:
            return text
        return ",".join([*(str(each) for each in dict(info).values()), text])

    def _print_block(self, message: Any, info: Any) -> None:
        chosen = self._arguments
        if chosen.include_message_info:
            import yaml

            print(yaml.dump(dict(info)), end="---\n")
        text = message_to_yaml(
            message,
            truncate_length=self._limit,
            no_arr=chosen.no_arr,
            no_str=chosen.no_str,
            flow_style=chosen.flow_style,
        )
        print(text, end="---\n")


def message_filter(expression: str | None) -> Callable[[Any], bool]:
    """Compile a filter expression to a predicate for messages; raises `SyntaxError` if it is not an expression."""
    if expression is None:
        return lambda message: True
    code = compile(expression, "<string>", "eval")
    return lambda message: bool(eval(code, {"m": message}))


def _message_class(node: Node, arguments: argparse.Namespace) -> Any:
    """Return the class to subscribe with, or the reason why it is not available as a string."""
    if arguments.message_type:
        invalid = "The passed message type is invalid"
        return class_of_typed_name(get_message, "msg", arguments.message_type, invalid, node)
    name = absolute_name(arguments.topic_name)
    types = dict(node.get_topic_names_and_types()).get(name)
    if not types:
        print(f"WARNING: topic [{arguments.topic_name}] does not appear to be published yet")
        return "Could not determine the type for the passed topic"
    if len(types) > 1:
        return f"Cannot echo topic '{arguments.topic_name}', as it contains more than one type: [{', '.join(types)}]"
    return message_class(node, name, types[0])


def _report_lost(info: Any) -> None:
    counts = f"\ttotal count change:{info.total_count_change}\n\ttotal count: {info.total_count}"
    print(f"A message was lost!!!\n{counts}", end="---\n")  # upstream does not end the line before the dashes, either


def echo(arguments: argparse.Namespace) -> Result:
    """`ros2 topic echo`."""
    printer = _Printer(arguments)
    with DirectNode(arguments) as node:
        kind = _message_class(node, arguments)
        if isinstance(kind, str):
            return kind
        qos = compatible_profile(arguments, "sensor_data", node.get_publishers_info_by_topic(arguments.topic_name))
        lost = None if arguments.no_lost_messages else SubscriptionEventCallbacks(message_lost=_report_lost)
        node.create_subscription(kind, arguments.topic_name, printer.show, qos, raw=arguments.raw, event_callbacks=lost)
        spin_until(node, lambda: printer.done, arguments.timeout)
    return printer.problem or None
