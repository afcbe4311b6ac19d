"""The cost of large launches: `python tests/benchmarks/bench_launch.py [--repeats N]`, JSON out.

Each run is a launch in a separate process; its CPU seconds include the start of the interpreter, which `start` shows
alone. `nodes` starts 200 nodes and stops them when all have reported that they are up: each must end cleanly.
`includes_*` reads 1000 launch files in 20 chains, each 50 deep. Medians of several runs, with the lowest and the
highest.
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

NODES = 200
CHAINS, DEPTH = 20, 50

NODE = """
import rclpy
from rclpy.node import Node


def main():
    rclpy.init()
    node = Node("n")
    node.create_timer(10.0, lambda: None)
    print("up", flush=True)
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass


if __name__ == "__main__":
    main()
"""

ALL_NODES = """
from launch import LaunchDescription
from launch.actions import RegisterEventHandler, Shutdown
from launch.event_handlers import OnProcessIO
from launch_ros.actions import Node

COUNT = {count}
UP = set()


def heard(event):
    if b"up" in event.text:
        UP.add(event.process_name)
    return Shutdown() if len(UP) == COUNT else None


def generate_launch_description():
    nodes = [Node(executable={path!r}, name=f"n{{number}}") for number in range(COUNT)]
    return LaunchDescription([RegisterEventHandler(OnProcessIO(on_stdout=heard)), *nodes])
"""

PYTHON = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription, LogInfo


def generate_launch_description():
    return LaunchDescription([DeclareLaunchArgument("a", default_value="1"), {below}])
"""
PYTHON_BELOW = ("IncludeLaunchDescription({path!r}, launch_arguments={{'a': '2'}}.items())", "LogInfo(msg='end')")
XML = '<launch>\n  <arg name="a" default="1"/>\n  {below}\n</launch>\n'
XML_BELOW = ('<include file="{path}"><arg name="a" value="2"/></include>', '<log message="end"/>')


def many_nodes(folder: Path) -> Path:
    """A launch file of many nodes."""
    node = folder / "node.py"
    node.write_text(NODE)
    return write_file(folder / "nodes.launch.py", ALL_NODES.format(count=NODES, path=str(node)))


def includes(folder: Path, ending: str, text: str, below: tuple[str, str]) -> Path:
    """A launch file that includes chains of launch files."""
    heads: list[Path] = []
    for chain in range(CHAINS):
        path = write_file(folder / f"{chain}_{DEPTH}.launch.{ending}", text.format(below=below[1]))
        for level in range(DEPTH - 1, 0, -1):
            own = folder / f"{chain}_{level}.launch.{ending}"
            path = write_file(own, text.format(below=below[0].format(path=str(path))))
        heads.append(path)
    separator = ", " if ending == "py" else "\n  "
    together = separator.join(below[0].format(path=str(head)) for head in heads)
    return write_file(folder / f"all.launch.{ending}", text.format(below=together))


def write_file(path: Path, text: str) -> Path:
    """Write a file; return its path."""
    path.write_text(text)
    return path


MEASURES: dict[str, tuple[Callable[[Path], Path], str, int]] = {
    "start": (lambda folder: write_file(folder / "empty.launch.xml", "<launch/>"), "", 0),
    "nodes": (many_nodes, "process has finished cleanly", NODES),
    "includes_python": (lambda folder: includes(folder, "py", PYTHON, PYTHON_BELOW), "[launch.user]: end", CHAINS),
    "includes_xml": (lambda folder: includes(folder, "xml", XML, XML_BELOW), "[launch.user]: end", CHAINS),
}
GOALS = {"nodes": 3.0, "includes_python": 5.0, "includes_xml": 5.0}


def cpu_of_launch(make: Callable[[Path], Path], message: str, times: int) -> float:
    """CPU seconds of a launch to its end; raises `RuntimeError` unless it succeeds and prints `message` so often."""
    with tempfile.TemporaryDirectory() as folder:
        path = make(Path(folder))
        environment = {**os.environ, "ROS_LOG_DIR": folder, "PYTHONDONTWRITEBYTECODE": "1"}
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run(
            [sys.executable, "-m", "bot_console.tui", "launch", str(path)],
            cwd=folder,
            env=environment,
            capture_output=True,
            text=True,
            check=False,
        )
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0 or (message and done.stdout.count(message) != times):
        raise RuntimeError(
            f"the launch of {path.name} did not do its work:\n{done.stdout[-2000:]}{done.stderr[-2000:]}"
        )
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description="CPU seconds of large launches.")
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--only", choices=sorted(MEASURES), action="append")
    options = parser.parse_args()
    report: dict[str, object] = {"unit": "CPU s", "goals": GOALS, "repeats": options.repeats}
    for name in options.only or MEASURES:
        costs = [cpu_of_launch(*MEASURES[name]) for _ in range(options.repeats)]
        report[name] = {
            "median": round(statistics.median(costs), 2),
            "low": round(min(costs), 2),
            "high": round(max(costs), 2),
        }
    print(json.dumps(report, indent=2))


if __name__ == "__main__":
    main()
