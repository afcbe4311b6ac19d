"""Writes the tables of the documentation that are generated from the code: keys, parameters, arguments, options.

    python tools/tables.py          # rewrites docs/*.md between <!-- table: NAME --> and <!-- end -->
    python tools/tables.py measure  # runs the four profiles as well and prints the rows of the environment guide

A test compares the documents with the code; run this script after changing a key or a parameter.
"""

from __future__ import annotations

import argparse
import json
import re
import subprocess
import sys
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from bot_console.runtime.importer import install
from bot_console.runtime.workspace.demos import EXECUTABLES

install()

import rclpy
import yaml
from ament_index_python.packages import get_package_share_directory
from bot_console.tui.cli import arguments as console_arguments
from bot_console.tui.cli.verbs import run as console_run
from bot_console.tui.keymap import TABLE
from bot_console.tui.keys.key import key_text
from bot_console_robot.controller_node import MotionController
from bot_console_robot.robot_node import RobotNavigator
from bot_console_robot.safety_node import SafetyMonitor
from bot_console_robot.sensor_node import SensorHandler
from bot_console_robot.simulator_node import Simulator
from bot_console_robot.telemetry_node import TelemetryPublisher
from launch.launch_description_sources import get_launch_description_from_any_launch_file
from launch.utilities import perform_substitutions
from rcl_interfaces.msg import ParameterDescriptor
from rclpy.node import Node
from rclpy.parameter import Parameter
from ros2cli.command_line import COMMANDS, load

from launch import LaunchContext

ROOT = Path(__file__).resolve().parents[1]
DOCS = ROOT / "docs"
BLOCK = re.compile(r"(<!-- table: ([\w.:-]+) -->\n).*?(<!-- end -->)", re.DOTALL)
UNIT = re.compile(r" \(([^()\d][^()]*)\)$")
BUILT_IN = ("use_sim_time", "start_type_description_service")
WORDS = {"BOOL": "boolean", "INTEGER": "integer", "DOUBLE": "double", "STRING": "string"}
NODES: tuple[type[Node], ...] = (
    *(RobotNavigator, SensorHandler, SafetyMonitor),
    *(MotionController, TelemetryPublisher, Simulator),
)
PROFILES = ("indoor", "warehouse", "outdoor", "competition")
SEEDS = (1, 2, 3)
DURATION = 120
"""Simulated seconds of a measured run."""


def keys(scope: str) -> str:
    """The keys of one scope of the key table."""
    rows = ((" ".join(f"`{each}`" for each in key_text(key).split()), key.text) for key in TABLE[scope])
    return _table(("key", "what it does"), rows)


def parameters(make_node: Callable[[], Node]) -> str:
    """The parameters that a node declares."""
    rclpy.init()
    try:
        node = make_node()
        names = [each for each in node._parameters if each not in BUILT_IN]
        rows = [_parameter(node.get_parameter(each), node.describe_parameter(each)) for each in names]
        node.destroy_node()
    finally:
        rclpy.shutdown()
    return _table(("parameter", "type", "default", "range", "unit", "description"), rows)


def _parameter(parameter: Parameter, descriptor: ParameterDescriptor) -> tuple[str, ...]:
    text = descriptor.description
    unit = UNIT.search(text)
    spans = [*descriptor.floating_point_range, *descriptor.integer_range]
    span = f"{spans[0].from_value:.10g} to {spans[0].to_value:.10g}" if spans else ""
    return (
        f"`{parameter.name}`",
        WORDS[parameter.type_.name],
        f"`{_value(parameter.value)}`",
        span,
        unit[1] if unit else "",
        text[: unit.start()] if unit else text,
    )


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    return repr(round(value, 10)) if isinstance(value, float) else str(value)


def arguments(file: str) -> str:
    """The arguments that a launch file declares; `<name>` in a default stands for another argument's value."""
    description = get_launch_description_from_any_launch_file(str(ROOT / "launch" / file))
    declared = description.get_launch_arguments()
    context = LaunchContext()
    context.launch_configurations.update({each.name: f"<{each.name}>" for each in declared})
    return _table(("argument", "default", "choices", "description"), (_argument(each, context) for each in declared))


def _argument(argument: Any, context: LaunchContext) -> tuple[str, ...]:
    default = "required"
    if argument.default_value is not None:
        share = get_package_share_directory("bot_console_robot")
        text = perform_substitutions(context, argument.default_value).replace(f"{share}/", "")
        default = f"`{text}`" if text else "(empty)"
    choices = ", ".join(f"`{each}`" for each in argument.choices or ())
    return f"`{argument.name}`", default, choices, argument.description.partition(" Valid choices are")[0].rstrip(".")


def profiles() -> str:
    """The values of the four profiles side by side, by node."""
    read = {name: _flat(yaml.safe_load((ROOT / "profiles" / f"{name}.yaml").read_text("utf-8"))) for name in PROFILES}
    names = dict.fromkeys(name for values in read.values() for name in values)
    rows = ((f"`{name}`", *(f"`{_value(read[each][name])}`" for each in PROFILES)) for name in names)
    return _table(("parameter", *PROFILES), rows)


def _flat(data: dict[str, Any]) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for node, content in data.items():
        for name, value in content["ros__parameters"].items():
            below = value if isinstance(value, dict) else None
            found |= {f"{node} {name}.{last}": each for last, each in below.items()} if below else {}
            found |= {} if below else {f"{node} {name}": value}
    return found


def options(parser: argparse.ArgumentParser) -> str:
    """The options of a command, without those that every command has."""
    rows = (
        (_written(each), str(each.help or "").replace("<", "&lt;"))
        for each in parser._actions
        if each.dest not in ("help", "version")
    )
    return _table(("option", "what it does"), rows)


def _written(action: argparse.Action) -> str:
    metavar = f" {action.metavar}" if isinstance(action.metavar, str) and action.nargs != 0 else ""
    names = [f"`{each}{metavar}`" for each in action.option_strings]
    return ", ".join(names) or f"`{action.metavar or action.dest}`"


def launch_parser() -> argparse.ArgumentParser:
    """The parser of `ros2 launch`."""
    parser = argparse.ArgumentParser("ros2 launch")
    command = load("launch")
    assert command is not None
    command.arguments(parser)
    return parser


def verbs() -> str:
    """The verbs of each `ros2` command."""
    loaded = ((name, load(name)) for name in COMMANDS)
    found = {name: [f"`{each.name}`" for each in command.verbs] for name, command in loaded if command}
    return _table(("command", "verbs"), ((f"`{name}`", ", ".join(each)) for name, each in found.items() if each))


def tutorials() -> str:
    """The packages of the tutorials with their executables."""
    rows = ((f"`{name}`", ", ".join(f"`{each}`" for each in rows)) for name, rows in EXECUTABLES.items())
    return _table(("package", "executables"), rows)


def _table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "".join("| " + " | ".join(each.replace("|", "\\|") for each in line) + " |\n" for line in lines)


LAUNCH_FILES = sorted(path.name for path in (ROOT / "launch").glob("*.launch.py"))
TABLES: dict[str, Callable[[], str]] = {
    **{f"keys:{scope}": partial(keys, scope) for scope in TABLE},
    **{f"parameters:{each.__name__}": partial(parameters, each) for each in NODES},
    **{f"arguments:{each}": partial(arguments, each) for each in LAUNCH_FILES},
    "options:bot-console": lambda: options(console_arguments.option_parser()),
    "options:run": lambda: options(console_run._parser()),
    "options:launch": lambda: options(launch_parser()),
    "tutorials": tutorials,
    "verbs": verbs,
    "profiles": profiles,
}


def fill_tables(text: str) -> str:
    """A document with its tables regenerated; raises `KeyError` for an unknown table."""
    return BLOCK.sub(lambda found: f"{found[1]}{TABLES[found[2]]()}{found[3]}", text)


def table_names(text: str) -> list[str]:
    """The names of the tables in a document."""
    return [found[2] for found in BLOCK.finditer(text)]


def measure() -> str:
    """The figures of the four profiles, over three seeds; takes a minute."""
    rows: list[tuple[str, ...]] = []
    for profile in PROFILES:
        for seed in SEEDS:
            words = ["--headless", "--fast", "--profile", profile, "--duration", str(DURATION), "--seed", str(seed)]
            done = subprocess.run(
                [sys.executable, "-m", "bot_console.tui", *words], check=True, capture_output=True, text=True
            )
            report = json.loads(done.stdout)
            figures = f"{report['mean_speed']:.2f}", f"{report['min_clearance']:.2f}"
            rows.append((profile, str(seed), *figures, str(report["stops"]), str(report["collisions"])))
    head = ("profile", "seed", "mean speed (m/s)", "minimum clearance (m)", "stops", "collisions")
    return _table(head, rows)


def main() -> None:
    """Rewrite the documents that have changed."""
    if sys.argv[1:] == ["measure"]:
        print(measure())
        return
    for path in sorted(DOCS.glob("*.md")):
        old = path.read_text("utf-8")
        new = fill_tables(old)
        if new != old:
            path.write_text(new, "utf-8")
            print(f"{path.relative_to(ROOT)} rewritten")


if __name__ == "__main__":
    main()
