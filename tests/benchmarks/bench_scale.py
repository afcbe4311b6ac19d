"""How the cost grows with the system: `python tests/benchmarks/bench_scale.py [CURVE ...]`, JSON out.

CPU time, the minimum of several runs; the `growth` of a curve is its last entry divided by its first, within one run.
"""

from __future__ import annotations

import json
import math
import sys
import threading
import time
from collections.abc import Callable
from typing import Any

from bot_console.runtime.importer import install

install()

import rclpy
from bot_console.tui.console.graph.watch import GraphWatch
from bot_console.tui.console.ros_console import RosConsole
from bot_console.tui.session.embedded.hooks import graph_events
from rcl_interfaces.msg import ParameterEvent
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Float64

RUNS = 5
MILLI, MICRO = 1e3, 1e6


def least(action: Callable[[], Any], count: int) -> float:
    """Seconds of CPU time per item of an action on `count` items, the minimum of several runs."""
    found: list[float] = []
    for _ in range(RUNS):
        start = time.process_time()
        action()
        found.append((time.process_time() - start) / count)
    return min(found)


def set_atomically(count: int) -> float:
    """Microseconds per parameter of a `set_parameters_atomically` whose event has a subscriber."""
    node, executor = rclpy.create_node("tuned"), SingleThreadedExecutor()
    node.declare_parameters("", [(f"p{number}", 0.0) for number in range(count)])
    node.create_subscription(ParameterEvent, "/parameter_events", lambda event: None, 10)
    executor.add_node(node)
    parameters = [Parameter(f"p{number}", value=1.0) for number in range(count)]
    times = max(1, 10_000 // count)

    def action() -> None:
        for _ in range(times):
            node.set_parameters_atomically(parameters)
            executor.spin_once(timeout_sec=0)

    cost = least(action, times * count)
    end(executor, [node])
    return cost * MICRO


def fan_out(count: int) -> float:
    """Microseconds per subscription that receives a scan of 360 ranges and intensities, callback included."""
    executor = SingleThreadedExecutor()
    nodes = [rclpy.create_node(f"listener{number}") for number in range(count)]
    for node in nodes:
        node.create_subscription(LaserScan, "scan", lambda scan: None, 10)
        executor.add_node(node)
    publisher = nodes[0].create_publisher(LaserScan, "scan", 10)
    scan = LaserScan(ranges=[1.0] * 360, intensities=[2.0] * 360)
    times = max(1, 5_000 // count)

    def action() -> None:
        for _ in range(times):
            publisher.publish(scan)
            for _ in range(count):
                executor.spin_once(timeout_sec=0)

    cost = least(action, times * count)
    end(executor, nodes)
    return cost * MICRO


class WatchedGraph:
    """`count` nodes with two publishers, two subscriptions and the usual services each, and a console's graph poll."""

    def __init__(self, count: int) -> None:
        self.nodes = [rclpy.create_node(f"node{number}") for number in range(count)]
        for number, node in enumerate(self.nodes):
            for each in (number, (number + 1) % count):
                node.create_publisher(Float64, f"topic{each}", 10)
                node.create_subscription(Float64, f"topic{each}", lambda message: None, 10)
        self.console = rclpy.create_node("_console")
        self.watch = GraphWatch(self.console, lambda graph: None, graph_events)

    def end(self) -> None:
        """Clean up, so that no curve affects the next one."""
        self.watch.close()
        for node in (*self.nodes, self.console):
            node.destroy_node()


def first_poll(count: int) -> float:
    """Milliseconds of the console's first poll of a graph."""
    watched = WatchedGraph(count)
    cost = least(lambda: GraphWatch(watched.console, lambda graph: None).poll(), 1)
    watched.end()
    return cost * MILLI


def poll_after_change(count: int) -> float:
    """Milliseconds of a poll after one publisher came or went."""
    watched, costs = WatchedGraph(count), []
    watched.watch.poll()
    for number in range(2 * RUNS):
        publisher = watched.nodes[0].create_publisher(Float64, f"new{number}", 10)
        start = time.process_time()
        watched.watch.poll()
        costs.append(time.process_time() - start)
        watched.nodes[0].destroy_publisher(publisher)
    watched.end()
    return min(costs) * MILLI


def parameters_read(count: int) -> float:
    """Seconds of CPU time until a new console has read 20 parameters of each node, including the nodes' own time."""
    executor = SingleThreadedExecutor()
    nodes = [rclpy.create_node(f"node{number}") for number in range(count)]
    for node in nodes:
        node.declare_parameters("", [(f"p{number}", float(number)) for number in range(20)])
        executor.add_node(node)
    threading.Thread(target=executor.spin, daemon=True).start()
    console = RosConsole()
    start = time.process_time()
    console.start()

    def complete() -> bool:
        trees = console.snapshot().parameters.values()
        return len(trees) >= count and not any(each.problem for each in trees)

    deadline = time.monotonic() + 120
    while not complete() and time.monotonic() < deadline:
        time.sleep(0.05)
    cost = time.process_time() - start if complete() else math.nan
    console.close()
    end(executor, nodes)
    return cost


def end(executor: Any, nodes: list[Any]) -> None:
    """Clean up, so that no curve affects the next one."""
    executor.shutdown()
    for node in nodes:
        node.destroy_node()


CURVES: dict[str, tuple[Callable[[int], float], tuple[int, ...]]] = {
    "set_parameters_atomically_us_each": (set_atomically, (10, 100, 1_000, 10_000)),
    "laserscan_fan_out_us_each": (fan_out, (1, 10, 50, 200)),
    "first_look_ms": (first_poll, (10, 50, 200, 500)),
    "parameters_read_s": (parameters_read, (10, 100, 500)),
    "look_after_change_ms": (poll_after_change, (10, 50, 200, 500)),
}


def main(wanted: list[str]) -> None:
    """Measure the named curves, or all of them."""
    rclpy.init(args=[])
    table: dict[str, Any] = {}
    for name in wanted or CURVES:
        measure, sizes = CURVES[name]
        row = {size: measure(size) for size in sizes}
        first, *_, last = row.values()
        table[name] = {**{size: round(value, 2) for size, value in row.items()}, "growth": round(last / first, 2)}
    print(json.dumps(table, indent=1))
    rclpy.shutdown()


if __name__ == "__main__":
    main(sys.argv[1:])
