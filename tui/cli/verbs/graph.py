"""`bot-console graph`: prints the ROS graph as YAML or text, lists its findings, or compares it with a file."""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace

from bot_console.tui.cli.numbers import positive, seconds
from bot_console.tui.console.graph.anomalies import findings
from bot_console.tui.console.graph.connections import connections, unconnected
from bot_console.tui.console.graph.expected import ExpectedGraph, differences, read_file, written
from bot_console.tui.console.graph.hidden_names import is_hidden, is_own_service
from bot_console.tui.console.model import GraphInfo
from bot_console.tui.console.ros_console import RosConsole
from bot_console.tui.console.topics.port import Measure
from bot_console.tui.session.reached_console import reached_console, wait_until_settled
from bot_console.tui.settings.settings import read_settings
from bot_console.tui.text.counted import counted
from bot_console.tui.text.sanitize import sanitize

PARAMETERS_TIMEOUT_S = 15.0
"""Seconds to wait for the parameters of all nodes."""
GRAPH_SETTLED_S = 1.0
"""Seconds without a change after which the graph counts as known."""

EPILOG = """exit codes: 0 as expected or nothing wrong, 1 differences or findings, 2 wrong usage or an unreadable file

The file is YAML, as `bot-console graph` writes it; every part is optional:
  nodes: [/robot_navigator, /safety_monitor]
  topics:
    /odom: {type: nav_msgs/msg/Odometry, publishers: [/simulator], rate: 50, tolerance: 0.1}
    /scan: {rate: 10, max_age: 0.5}   # Hz (tolerance: 0.2 of it, unless given); seconds
  services: {/reset: std_srvs/srv/Trigger}
  exact: false   # true: anything else is a difference
A parameter file with rates for greenwave_monitor (topics./scan.expected_frequency) works, too. E in the Topics pane, or
`expected:` in the settings, checks the same file all the time.
"""


def run(words: list[str]) -> int:
    """Print, check or compare the graph of the domain; returns the exit code."""
    given = _parser().parse_args(words)
    expected = None
    if given.check:
        try:
            expected = read_file(given.check)
        except ValueError as error:
            print(f"{given.check} cannot be used: {sanitize(str(error))}", file=sys.stderr)
            return 2
    with reached_console(learning=given.launch is not None) as console:
        return 1 if console is None else _run(console, expected, given)


def _run(console: RosConsole, expected: ExpectedGraph | None, given: argparse.Namespace) -> int:
    if expected is not None:
        return _compare(console, expected, given)
    if given.launch is not None:
        return _write_launch(console, given)
    info = _settled_graph(console, given.wait)
    if given.findings:
        found = findings(info)
        for each in found:
            print(f"{'fault' if each.fault else 'hint '}  {sanitize(each.text)}")
        return 1 if any(each.fault for each in found) else 0
    if given.text:
        print(*lines_of(info, read_settings().graph_hides), sep="\n")
        return 0
    topics = [each.name for each in info.topics] if given.rates else []
    print(written(info, _measured(console, topics, given.measure)), end="")
    return 0


def _with_parameters(console: RosConsole) -> tuple[GraphInfo, bool]:
    """The graph, and whether all of its nodes with parameters have reported them."""
    snapshot = console.snapshot()
    nodes = [each for each in snapshot.graph.nodes if not each.hidden]
    offered = {n.name for n in nodes for each in n.services if each.name == f"{n.name}/list_parameters"}
    return snapshot.graph, bool(nodes) and offered <= snapshot.parameters.keys()


def _write_launch(console: RosConsole, given: argparse.Namespace) -> int:
    wait_until_settled(
        lambda: _with_parameters(console),
        lambda found: found[1],
        GRAPH_SETTLED_S,
        max(given.wait, PARAMETERS_TIMEOUT_S),
    )
    answer = console.graph.write_launch(given.launch)
    print(sanitize(answer.text), file=sys.stdout if answer.ok else sys.stderr)
    return 0 if answer.ok else 2


def lines_of(info: GraphInfo, hides: Iterable[str]) -> Iterator[str]:
    """A line for each topic, service and action with its two sides, then for each node that has none of them.

    Names that match `hides` are left out, as in the graph pane, and so are private services that nobody calls.
    """
    hides = tuple(hides)
    info = replace(info, nodes=tuple(each for each in info.nodes if not is_hidden(each.name, hides)))
    found = [
        (kind, name, text)
        for kind, name, text in connections(info)
        if not is_hidden(name, hides) and not (kind == "service" and is_own_service(name, info.nodes))
    ]
    yield from (sanitize(text) for _, _, text in found)
    alone = unconnected(info.nodes, {(kind, name) for kind, name, _ in found})
    yield from (f"{sanitize(each)}  without topics, services and actions" for each in alone)


def _compare(console: RosConsole, expected: ExpectedGraph, given: argparse.Namespace) -> int:
    """Wait until the graph matches, then measure rates; print each difference and return the exit code.

    A graph that still changes does not match yet: what must not exist may not have been discovered.
    """
    info = wait_until_settled(
        lambda: console.snapshot().graph, lambda info: not differences(expected, info), GRAPH_SETTLED_S, given.wait
    )
    found = differences(expected, info)
    if not found and expected.measured:
        measured = _measured(console, list(expected.measured), given.measure)
        found = differences(expected, console.snapshot().graph, measured)
    for each in found:
        print(sanitize(each))
    parts = f"{counted(len(expected.nodes), 'node')}, {counted(len(expected.topics), 'topic')}"
    print(counted(len(found), "difference") if found else f"as expected: {parts}", file=sys.stderr)
    return 1 if found else 0


def _settled_graph(console: RosConsole, wait: float) -> GraphInfo:
    """The graph, once it has nodes and stops changing; at the latest after `wait` seconds."""

    def has_nodes(info: GraphInfo) -> bool:
        return any(not each.hidden for each in info.nodes)

    return wait_until_settled(lambda: console.snapshot().graph, has_nodes, GRAPH_SETTLED_S, wait)


def _measured(console: RosConsole, topics: list[str], seconds: float) -> Mapping[str, Measure]:
    if not topics:
        return {}
    console.topics.measure(topics)
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        time.sleep(min(1.0, max(0.0, end - time.monotonic())))
        console.topics.measured()
    return console.topics.measured()


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        "bot-console graph",
        description="Print the ROS graph as YAML or as lines of text, list what looks wrong, or compare with a file.",
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    what = parser.add_mutually_exclusive_group()
    what.add_argument("--check", metavar="FILE", help="compare with a file, and print a line for each difference")
    what.add_argument("--text", action="store_true", help="print a line for each topic, service and action")
    what.add_argument(
        "--findings", action="store_true", help="print what looks wrong, such as a topic that nobody publishes"
    )
    what.add_argument(
        "--launch",
        nargs="?",
        const="live.launch.py",
        metavar="FILE",
        help="write a launch file, and a parameter file beside it, that start the running nodes again (default: "
        "live.launch.py)",
    )
    parser.add_argument("--rates", action="store_true", help="also write the rates of topics")
    parser.add_argument(
        "--wait", type=seconds, default=5.0, metavar="S", help="seconds to wait for the graph (default: 5)"
    )
    parser.add_argument(
        "--measure", type=positive, default=5.0, metavar="S", help="seconds to measure rates (default: 5)"
    )
    return parser
