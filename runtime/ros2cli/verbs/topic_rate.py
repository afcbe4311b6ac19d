"""`ros2 topic hz`, `bw` and `delay`: measured over a window of messages, printed once a second."""

from __future__ import annotations

import argparse
import math
from collections import deque
from collections.abc import Callable
from typing import Any

import rclpy
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from rclpy.serialization import serialize_message
from ros2cli.command import Result
from ros2cli.direct_node import DirectNode, add_strategy_arguments, spin_until
from ros2cli.verbs.topic_echo import _filter as message_filter
from rosidl_runtime_py.utilities import get_message

WINDOW = 10_000
BYTES_WINDOW = 100


def _positive(text: str) -> int:
    try:
        value = int(text)
    except ValueError:
        value = 0
    if value <= 0:
        raise argparse.ArgumentTypeError("value must be a positive integer")
    return value


def _window(parser: argparse.ArgumentParser, default: int, what: str) -> None:
    parser.add_argument(
        "--window", "-w", dest="window_size", type=_positive, default=default, metavar="WINDOW", help=what
    )


def rate_arguments(parser: argparse.ArgumentParser) -> None:
    """Options of `hz`."""
    parser.add_argument("topic_name", help="Name of the ROS topic to listen to (e.g. '/chatter')")
    _window(parser, WINDOW, f"window size, in # of messages, for calculating rate (default: {WINDOW})")
    parser.add_argument("--filter", dest="filter_expr", metavar="EXPR", default=None, help="only measure messages "
                        "matching the specified Python expression")  # fmt: skip
    parser.add_argument(
        "--wall-time",
        action="store_true",
        help="calculates rate using wall time which can be helpful when clock is not published during simulation",
    )
    add_strategy_arguments(parser, daemon=False)


def bandwidth_arguments(parser: argparse.ArgumentParser) -> None:
    """Options of `bw`."""
    parser.add_argument("topic", help="Topic name to monitor for bandwidth utilization")
    _window(
        parser, BYTES_WINDOW, f"maximum window size, in # of messages, for calculating rate (default: {BYTES_WINDOW})"
    )
    add_strategy_arguments(parser, daemon=False)


def delay_arguments(parser: argparse.ArgumentParser) -> None:
    """Options of `delay`."""
    parser.add_argument("topic_name", help="Topic name to calculate the delay for")
    _window(parser, WINDOW, f"window size, in # of messages, for calculating rate, string to (default: {WINDOW})")
    add_strategy_arguments(parser, daemon=False)


def _measure(node: Node, topic: str, take: Callable[[Any], None], tell: Callable[[], str]) -> Result:
    """Subscribe when the topic appears, and print once a second what there is to tell."""
    name = topic if topic.startswith("/") else f"/{topic}"
    if name not in dict(node.get_topic_names_and_types()):
        print(f"WARNING: topic [{topic}] does not appear to be published yet")
    spin_until(node, lambda: name in dict(node.get_topic_names_and_types()))
    kind = get_message(dict(node.get_topic_names_and_types())[name][0])
    node.create_subscription(kind, topic, take, qos_profile_sensor_data)
    while True:
        spin_until(node, lambda: False, 1.0)
        text = tell()
        if text:
            print(text)


def spread(values: list[float]) -> tuple[float, float, float, float]:
    """Mean, minimum, maximum and (population) standard deviation."""
    mean = sum(values) / len(values)
    return mean, min(values), max(values), math.sqrt(sum((each - mean) ** 2 for each in values) / len(values))


def rate(arguments: argparse.Namespace) -> Result:
    """`ros2 topic hz`."""
    gaps: deque[float] = deque(maxlen=arguments.window_size)
    passes = message_filter(arguments.filter_expr)
    last: list[int] = []
    arguments.no_daemon = True
    with DirectNode(arguments) as node:
        wall = rclpy.clock.Clock(clock_type=rclpy.clock.ClockType.SYSTEM_TIME)
        clock = wall if arguments.wall_time else node.get_clock()

        def take(message: Any) -> None:
            if passes(message):
                now = clock.now().nanoseconds
                if last and now > last[0]:
                    gaps.append((now - last[0]) * 1e-9)
                last[:] = [now]

        def tell() -> str:
            if not gaps:
                return ""
            mean, low, high, deviation = spread(list(gaps))
            return (
                f"average rate: {1.0 / mean:.3f}\n\tmin: {low:.3f}s max: {high:.3f}s "
                f"std dev: {deviation:.5f}s window: {len(gaps) + 1}"
            )

        return _measure(node, arguments.topic_name, take, tell)


def bandwidth(arguments: argparse.Namespace) -> Result:
    """`ros2 topic bw`."""
    sizes: deque[tuple[int, int]] = deque(maxlen=arguments.window_size)
    arguments.no_daemon = True
    with DirectNode(arguments) as node:
        clock = rclpy.clock.Clock(clock_type=rclpy.clock.ClockType.STEADY_TIME)

        def take(message: Any) -> None:
            sizes.append((clock.now().nanoseconds, len(serialize_message(message))))

        def tell() -> str:
            if len(sizes) < 2:
                return ""
            seconds = (clock.now().nanoseconds - sizes[0][0]) * 1e-9
            amounts = [size for _, size in sizes]
            total = _amount(sum(amounts) / seconds)
            mean, low, high = (_amount(each) for each in (sum(amounts) / len(amounts), min(amounts), max(amounts)))
            return f"{total}/s from {len(amounts)} messages\n\tMessage size mean: {mean} min: {low} max: {high}"

        return _measure(node, arguments.topic, take, tell)


def _amount(count: float) -> str:
    for unit, size in (("MB", 1e6), ("KB", 1e3)):
        if count >= size:
            return f"{count / size:.2f} {unit}"
    return f"{count:.0f} B" if count == int(count) else f"{count:.2f} B"


def delay(arguments: argparse.Namespace) -> Result:
    """`ros2 topic delay`."""
    delays: deque[float] = deque(maxlen=arguments.window_size)
    arguments.no_daemon = True
    with DirectNode(arguments) as node:

        def take(message: Any) -> None:
            stamp = message.header.stamp
            delays.append((node.get_clock().now().nanoseconds - stamp.sec * 1_000_000_000 - stamp.nanosec) * 1e-9)

        def tell() -> str:
            if not delays:
                return ""
            mean, low, high, deviation = spread(list(delays))
            return (
                f"average delay: {mean:.3f}\n\tmin: {low:.3f}s max: {high:.3f}s "
                f"std dev: {deviation:.5f}s window: {len(delays)}"
            )

        return _measure(node, arguments.topic_name, take, tell)
