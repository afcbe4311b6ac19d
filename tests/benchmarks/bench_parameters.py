"""The cost of parameters: `python tests/benchmarks/bench_parameters.py [RUNS]`, JSON out.

CPU time in microseconds, medians of several runs with spread; ratios are within one run. The floor is the cost of
creating and sending the messages of one change, without any rules.
"""

from __future__ import annotations

import json
import statistics
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from bot_console.runtime.importer import install

install()

import rclpy
from rcl_interfaces.msg import (
    FloatingPointRange,
    ParameterDescriptor,
    ParameterEvent,
    ParameterValue,
    SetParametersResult,
)
from rcl_interfaces.msg import Parameter as ParameterMsg
from rcl_interfaces.srv import SetParameters
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter

SETS = 5_000
ENTRIES = 1_000
TOGETHER = 40_000
MANY = 10_000
"""Parameters that are set together."""


def validate(parameters: list[Parameter]) -> SetParametersResult:
    for parameter in parameters:
        if parameter.name == "speed" and not 0.1 <= parameter.value <= 5.0:
            return SetParametersResult(successful=False, reason="Speed must be between 0.1 and 5.0")
    return SetParametersResult(successful=True)


def node_with_speed() -> Any:
    node = rclpy.create_node("bench")
    limits = FloatingPointRange(from_value=0.0, to_value=5.0)
    node.declare_parameter("speed", 1.0, ParameterDescriptor(floating_point_range=[limits]))
    node.add_on_set_parameters_callback(validate)
    return node


def per_call(action: Callable[[int], Any], count: int) -> float:
    start = time.process_time()
    for number in range(count):
        action(number)
    return (time.process_time() - start) / count * 1e6


def floor_of_a_change() -> float:
    """Create and copy, as the bus does, the results of the callback and of the call, and the event."""

    def make(number: int) -> None:
        SetParametersResult(successful=True)
        SetParametersResult(successful=True)
        value = ParameterValue(type=3, double_value=float(number))
        event = ParameterEvent(node="/bench", changed_parameters=[ParameterMsg(name="speed", value=value)])
        event._copy_()

    return per_call(make, SETS)


def local_set(watched: bool) -> float:
    """`set_parameters` of one parameter with range and callback; a subscription receives the event if `watched`."""
    node = node_with_speed()
    if watched:
        node.create_subscription(ParameterEvent, "/parameter_events", lambda event: None, 10)
    values = [1.0 + number % 100 / 100 for number in range(SETS)]
    cost = per_call(lambda number: node.set_parameters([Parameter("speed", value=values[number])]), SETS)
    node.destroy_node()
    return cost


def set_together(count: int, heard: bool = False) -> float:
    """`set_parameters_atomically` of `count` parameters, per parameter; if `heard`, another node receives events."""
    node = rclpy.create_node("together")
    for number in range(count):
        node.declare_parameter(f"p{number}", 0.0)
    if heard:
        return set_together_with_listener(node, count)
    rounds = [
        [Parameter(f"p{number}", value=float(turn)) for number in range(count)] for turn in range(TOGETHER // count)
    ]
    cost = per_call(lambda number: node.set_parameters_atomically(rounds[number]), len(rounds)) / count
    node.destroy_node()
    return cost


def set_together_with_listener(node: Any, count: int) -> float:
    """Like `set_together`, with another node's subscription to `/parameter_events`, served after each change."""
    got: list[int] = []
    hearer, executor = rclpy.create_node("hearer"), SingleThreadedExecutor()
    executor.add_node(hearer)
    hearer.create_subscription(
        ParameterEvent, "/parameter_events", lambda event: got.append(len(event.changed_parameters)), 10
    )
    rounds = [
        [Parameter(f"p{number}", value=float(turn)) for number in range(count)] for turn in range(TOGETHER // count)
    ]

    def change(number: int) -> None:
        node.set_parameters_atomically(rounds[number])
        while len(got) <= number:
            executor.spin_once()

    cost = per_call(change, len(rounds)) / count
    assert got == [count] * len(rounds)
    executor.shutdown()
    for each in (node, hearer):
        each.destroy_node()
    return cost


def service_call() -> float:
    """Request and reply of `SetParameters` between two nodes of one executor."""
    server, client = node_with_speed(), rclpy.create_node("asker")
    executor = SingleThreadedExecutor()
    for node in (server, client):
        executor.add_node(node)
    requester = client.create_client(SetParameters, "/bench/set_parameters")
    request = SetParameters.Request(parameters=[Parameter("speed", value=2.0).to_parameter_msg()])

    def call(number: int) -> None:
        future = requester.call_async(request)
        while not future.done():
            executor.spin_once()

    cost = per_call(call, SETS // 5)
    executor.shutdown()
    for node in (server, client):
        node.destroy_node()
    return cost


def read() -> float:
    """`get_parameter(...).value`."""
    node = node_with_speed()
    cost = per_call(lambda number: node.get_parameter("speed").value, SETS)
    node.destroy_node()
    return cost


def parameter_file() -> float:
    """Read a file of many values and declare them, per value."""
    lines = "".join(f"    group{number // 50}.p{number}: {number / 8}\n" for number in range(ENTRIES))
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "many.yaml"
        path.write_text("/**:\n  ros__parameters:\n" + lines)
        words = ["--ros-args", "--params-file", str(path)]
        start = time.process_time()
        node = rclpy.create_node("many", cli_args=words, automatically_declare_parameters_from_overrides=True)
        cost = (time.process_time() - start) / ENTRIES * 1e6
        node.destroy_node()
    return cost


MEASURES: dict[str, Callable[[], float]] = {
    "floor_us": floor_of_a_change,
    "local_set_us": lambda: local_set(False),
    "local_set_watched_us": lambda: local_set(True),
    "together_10_us_each": lambda: set_together(10),
    f"together_{MANY}_us_each": lambda: set_together(MANY),
    "together_10_heard_us_each": lambda: set_together(10, heard=True),
    f"together_{MANY}_heard_us_each": lambda: set_together(MANY, heard=True),
    "service_call_us": service_call,
    "get_parameter_us": read,
    "file_and_declare_us_each": parameter_file,
}


def main(runs: int) -> None:
    rclpy.init(args=[])
    rows: dict[str, list[float]] = {name: [] for name in MEASURES}
    for _ in range(runs):
        for name, measure in MEASURES.items():
            rows[name].append(measure())
    found: dict[str, Any] = {
        name: {"median": round(statistics.median(row), 3), "low": round(min(row), 3), "high": round(max(row), 3)}
        for name, row in rows.items()
    }
    ratios = [set_ / floor for set_, floor in zip(rows["local_set_us"], rows["floor_us"], strict=True)]
    found["local_set_over_floor"] = round(statistics.median(ratios), 2)
    for heard in ("", "_heard"):
        pairs = zip(rows[f"together_{MANY}{heard}_us_each"], rows[f"together_10{heard}_us_each"], strict=True)
        found[f"together{heard}_many_over_ten"] = round(statistics.median(many / ten for many, ten in pairs), 2)
    print(json.dumps(found, indent=2))
    rclpy.shutdown()


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 5)
