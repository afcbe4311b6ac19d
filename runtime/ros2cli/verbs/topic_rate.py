"""`ros2 topic hz`, `bw` and `delay`: measured over a window of messages, printed once a second."""

from __future__ import annotations

import argparse
import math
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from ros2cli.command import Result
from ros2cli.direct_node import DirectNode, absolute_name, add_strategy_arguments, spin_until
from ros2cli.type_discovery import message_class
from ros2cli.verbs.topic_echo import message_filter

WINDOW = 10_000
BYTES_WINDOW = 100
"""The number of messages in the window, by default and always for `bw`."""
SECOND_NS = 1_000_000_000


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
    """Add the options of `hz`."""
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
    """Add the options of `bw`."""
    parser.add_argument("topic", help="Topic name to monitor for bandwidth utilization")
    _window(
        parser, BYTES_WINDOW, f"maximum window size, in # of messages, for calculating rate (default: {BYTES_WINDOW})"
    )
    add_strategy_arguments(parser, daemon=False)


def delay_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `delay`."""
    parser.add_argument("topic_name", help="Topic name to calculate the delay for")
    _window(parser, WINDOW, f"window size, in # of messages, for calculating rate, string to (default: {WINDOW})")
    add_strategy_arguments(parser, daemon=False)


def _subscribe(node: Node, topic: str, take: Callable[..., None], *, raw: bool = False) -> str:
    """Wait for the topic and subscribe to it; returns why that is impossible, or an empty string."""
    name = absolute_name(topic)
    if name not in dict(node.get_topic_names_and_types()):
        print(f"WARNING: topic [{topic}] does not appear to be published yet")
    spin_until(node, lambda: name in dict(node.get_topic_names_and_types()))
    kind = message_class(node, name, dict(node.get_topic_names_and_types())[name][0])
    if isinstance(kind, str):
        return kind
    node.create_subscription(kind, topic, take, qos_profile_sensor_data, raw=raw)
    return ""


def _print_each_second(node: Node, report: Callable[[], str]) -> Result:
    """Print the text that `report` returns, if any, once a second, for ever."""

    def show() -> None:
        if text := report():
            print(text)

    node.create_timer(1.0, show)
    spin_until(node, lambda: False)
    return None


def spread(values: Sequence[float]) -> tuple[float, float, float, float]:
    """Return mean, minimum, maximum and (population) standard deviation."""
    mean = sum(values) / len(values)
    return mean, min(values), max(values), math.sqrt(sum((each - mean) ** 2 for each in values) / len(values))


class _Rate:
    """Gaps (ns) between messages; a report is due with the first message at least 1 s after the last report."""

    def __init__(self, window: int) -> None:
        self.gaps: deque[int] = deque(maxlen=window)
        self._last = self._reported = 0

    def take(self, now: int) -> str:
        """Count a message received `now` (ns); returns the report if one is due, else an empty string."""
        last = self._last
        if now == 0:
            text = "time has reset, resetting counters" if self.gaps else ""
            self.gaps.clear()
            return text
        self._last = now
        if last == 0 or last > now:
            self.gaps.clear()
            return ""
        self.gaps.append(now - last)
        if self._reported == 0:
            self._reported = now
        elif now - self._reported >= SECOND_NS:
            self._reported = now
            return self._report()
        return ""

    def _report(self) -> str:
        mean, low, high, deviation = (each * 1e-9 for each in spread(list(self.gaps)))
        return (
            f"average rate: {1.0 / mean if mean else 0.0:.3f}\n\tmin: {low:.3f}s max: {high:.3f}s "
            f"std dev: {deviation:.5f}s window: {len(self.gaps)}"
        )


def rate(arguments: argparse.Namespace) -> Result:
    """`ros2 topic hz`."""
    passes = message_filter(arguments.filter_expr)
    arguments.no_daemon = True
    with DirectNode(arguments) as node:
        clock = node.get_clock()
        simulated = arguments.use_sim_time and not arguments.wall_time
        measured = _Rate(arguments.window_size)

        def take(message: object, info: Mapping[str, int]) -> None:
            # Messages may have queued while the type of the topic was learned.
            now = clock.now().nanoseconds if simulated else info["received_timestamp"]
            if passes(message) and (text := measured.take(now)):
                print(text)

        problem = _subscribe(node, arguments.topic_name, take)
        if problem:
            return problem
        spin_until(node, lambda: False)
    return None


def bandwidth(arguments: argparse.Namespace) -> Result:
    """`ros2 topic bw`."""
    sizes: deque[tuple[int, int]] = deque(maxlen=arguments.window_size)
    arguments.no_daemon = True
    with DirectNode(arguments) as node:
        clock = node.get_clock() if arguments.use_sim_time else Clock(clock_type=ClockType.STEADY_TIME)

        def take(data: bytes) -> None:
            sizes.append((clock.now().nanoseconds, len(data)))

        def report() -> str:
            if len(sizes) < 2:
                return ""
            seconds = (clock.now().nanoseconds - sizes[0][0]) * 1e-9
            if seconds <= 0:  # the simulation was restarted
                sizes.clear()
                return ""
            amounts = [size for _, size in sizes]
            total = sum(amounts) / seconds
            shown = [_amount(each, total) for each in (total, sum(amounts) / len(amounts), min(amounts), max(amounts))]
            return (
                f"{shown[0]}/s from {len(amounts)} messages\n\tMessage size mean: {shown[1]} min: {shown[2]} "
                f"max: {shown[3]}"
            )

        problem = _subscribe(node, arguments.topic, take, raw=True)
        if problem:
            return problem
        print(f"Subscribed to [{arguments.topic}]")
        return _print_each_second(node, report)


def _amount(count: float, total: float) -> str:
    """Format a number of bytes in the unit that suits the total per second (B/s)."""
    if total < 1e3:
        return f"{count:.0f} B"
    return f"{count / 1e3:.2f} KB" if total < 1e6 else f"{count / 1e6:.2f} MB"


def delay(arguments: argparse.Namespace) -> Result:
    """`ros2 topic delay`; the first message is not measured. Raises `RuntimeError` for messages without a header."""
    delays: deque[int] = deque(maxlen=arguments.window_size)
    started = fresh = False
    arguments.no_daemon = True
    with DirectNode(arguments) as node:

        def take(message: Any) -> None:
            nonlocal started, fresh
            if not hasattr(message, "header"):
                raise RuntimeError("msg does not have header")
            stamp, now = message.header.stamp, node.get_clock().now().nanoseconds
            if now == 0:
                if delays:
                    print("time has reset, resetting counters")
                    delays.clear()
                return
            if started:
                delays.append(now - stamp.sec * SECOND_NS - stamp.nanosec)
            started = fresh = True

        def report() -> str:
            nonlocal fresh
            if not delays:
                return ""
            if not fresh:
                return "no new messages"
            fresh = False
            mean, low, high, deviation = (each * 1e-9 for each in spread(list(delays)))
            return (
                f"average delay: {mean:.3f}\n\tmin: {low:.3f}s max: {high:.3f}s "
                f"std dev: {deviation:.5f}s window: {len(delays)}"
            )

        problem = _subscribe(node, arguments.topic_name, take)
        return problem or _print_each_second(node, report)
