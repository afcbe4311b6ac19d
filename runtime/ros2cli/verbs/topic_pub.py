"""`ros2 topic pub`."""

from __future__ import annotations

import argparse
import itertools
import math
import sys
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import Any

from rclpy.clock import Clock, ClockType
from rclpy.duration import Duration
from rclpy.node import Node
from ros2cli.advice import advise, no_subscription
from ros2cli.command import Result
from ros2cli.direct_node import DirectNode, add_strategy_arguments, spin_until
from ros2cli.qos_arguments import add_qos_arguments, profile
from ros2cli.type_discovery import class_of_typed_name
from ros2cli.yaml_values import fill_message, read_values
from rosidl_runtime_py.utilities import get_message


def _positive(kind: Callable[[str], Any], text: str) -> Callable[[str], Any]:
    def convert(value: str) -> Any:
        number = kind(value)
        if number <= 0:
            raise argparse.ArgumentTypeError(text)
        return number

    convert.__name__ = kind.__name__
    return convert


POSITIVE_FLOAT = _positive(float, "Value must be positive")
POSITIVE_INT = _positive(int, "value must be a positive integer")


def _nonnegative(text: str) -> int:
    number = int(text)
    if number < 0:
        raise argparse.ArgumentTypeError("value must be positive or zero")
    return number


def arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the verb."""
    add = parser.add_argument
    add("topic_name", help="Name of the ROS topic to publish to (e.g. '/chatter')")
    add("message_type", help="Type of the ROS message (e.g. 'std_msgs/String')")
    add(
        "values",
        nargs="?",
        default="{}",
        help="Values to fill the message with in YAML format (e.g. 'data: Hello World'), otherwise the message will "
        "be published with default values",
    )
    add("--stdin", action="store_true", help="Read values from standard input")
    add("-r", "--rate", metavar="N", type=POSITIVE_FLOAT, default=1.0, help="Publishing rate in Hz (default: 1)")
    add(
        "-p",
        "--print",
        metavar="N",
        type=int,
        default=1,
        help="Only print every N-th published message (default: 1)",
    )
    how_often = parser.add_mutually_exclusive_group()
    how_often.add_argument("-1", "--once", action="store_true", help="Publish one message and exit")
    how_often.add_argument(
        "-t", "--times", type=POSITIVE_INT, default=0, help="Publish this number of times and then exit"
    )
    add(
        "-w",
        "--wait-matching-subscriptions",
        type=_nonnegative,
        default=None,
        help="Wait until finding the specified number of matching subscriptions. Defaults to 1 when using "
        '"-1"/"--once"/"--times", otherwise defaults to 0.',
    )
    add(
        "--max-wait-time-secs",
        type=POSITIVE_FLOAT,
        default=None,
        help="This sets the maximum wait time in seconds if --wait-until-matching-subscriptions is set. By default, "
        "this flag is not set meaning the subscriber will wait endlessly.",
    )
    add(
        "--keep-alive",
        metavar="N",
        type=POSITIVE_FLOAT,
        default=0.1,
        help="Keep publishing node alive for N seconds after the last msg (default: 0.1)",
    )
    add("-n", "--node-name", help="Name of the created publishing node")
    add_qos_arguments(parser, "publish", "default")
    add_strategy_arguments(parser, daemon=False)


def publish(arguments: argparse.Namespace) -> Result:
    """`ros2 topic pub`."""
    import yaml

    kind = class_of_typed_name(get_message, "msg", arguments.message_type, "The passed message type is invalid")
    if isinstance(kind, str):
        return kind
    values: Any = {} if arguments.stdin else read_values(arguments.values)
    if not isinstance(values, dict):
        return "The passed value needs to be a dictionary in YAML format"
    arguments.no_daemon = True
    with DirectNode(arguments, name=arguments.node_name or "") as node:
        publisher = node.create_publisher(kind, arguments.topic_name, profile(arguments, "default"))
        problem = _wait_for_subscriptions(node, publisher, arguments)
        if problem:
            return problem
        try:
            if arguments.stdin:
                messages = (_fill(kind, each) for each in yaml.safe_load_all(sys.stdin))
            else:
                messages = itertools.repeat(_fill(kind, values))
            _loop(node, publisher, messages, arguments)
        except _RefusedError as refused:
            return str(refused)
    return None


class _RefusedError(Exception):
    """The values do not fit the message."""


_Filled = tuple[Any, Sequence[Callable[[Any], None]]]


def _wait_for_subscriptions(node: Node, publisher: Any, arguments: argparse.Namespace) -> str:
    """Wait for the requested number, with a notice each second; returns an error message if too few appear."""
    wanted = arguments.wait_matching_subscriptions
    wanted = int(arguments.once or arguments.times > 0) if wanted is None else wanted
    left: float = math.inf if arguments.max_wait_time_secs is None else arguments.max_wait_time_secs
    count: Callable[[], int] = publisher.get_subscription_count
    hint: Callable[[], str] | None = partial(_why_unmatched, node, publisher, arguments.message_type)
    while count() < wanted:
        if left <= 0:
            # upstream's misspelling, as scripts search for this line
            return f"Timed out waiting for subscribers: Expected {wanted} subcribers but only got {count()} subscribers"
        print(f"Waiting for at least {wanted} matching subscription(s)...")
        spin_until(node, lambda: count() >= wanted, min(left, 1.0))
        left -= 1.0
        if hint and not count():
            advise(hint)
            hint = None
    return ""


def _why_unmatched(node: Node, publisher: Any, message_type: str) -> str:
    """Return, for a person, why nobody may receive the messages; empty if nothing is known."""
    topic = publisher.topic_name
    package, *_, name = message_type.split("/")
    kinds = [each.topic_type for each in node.get_subscriptions_info_by_topic(topic)]
    subscribed = [each for each, _ in node.get_topic_names_and_types() if node.count_subscribers(each)]
    return no_subscription(topic, f"{package}/msg/{name}", kinds, subscribed)


def _loop(node: Node, publisher: Any, messages: Iterator[_Filled], arguments: argparse.Namespace) -> None:
    """Publish the first message at once and the others from a timer, spinning the node until the last one."""
    sender = _Sender(node, publisher, messages, arguments)
    print("publisher: beginning loop")
    sender.send()
    if not sender.done:
        node.create_timer(1.0 / arguments.rate, sender.send)
        spin_until(node, lambda: sender.done)
    Clock(clock_type=ClockType.STEADY_TIME).sleep_for(Duration(seconds=arguments.keep_alive))


class _Sender:
    """Publishes messages one by one, prints every n-th, and is `done` after the last one."""

    def __init__(self, node: Node, publisher: Any, messages: Iterator[_Filled], arguments: argparse.Namespace) -> None:
        self._node = node
        self._publisher = publisher
        self._messages = messages
        self._report: int = arguments.print
        self._times: int = 1 if arguments.once else arguments.times
        self._count = 0
        self._following = next(messages, None)

    @property
    def done(self) -> bool:
        """Whether the last message has been published."""
        return self._following is None or bool(self._times and self._count >= self._times)

    def send(self) -> None:
        """Publish the next message, if there is one."""
        if self.done or self._following is None:
            return
        message, stamps = self._following
        now = self._node.get_clock().now().to_msg()
        for set_stamp in stamps:
            set_stamp(now)
        self._count += 1
        if self._report and self._count % self._report == 0:
            print(f"publishing #{self._count}: {message!r}\n")
        self._publisher.publish(message)
        if not self.done:
            self._following = next(self._messages, None)


def _fill(kind: Any, values: Any) -> _Filled:
    """Return a message with the values, and functions that set its time stamps just before it is sent."""
    message = kind()
    try:
        stamps = fill_message(message, values, expand_header_auto=True, expand_time_now=True)
    except Exception as error:  # a field may raise any exception about a value; upstream also catches all
        raise _RefusedError(f"Failed to populate field: {error}") from None
    return message, stamps
