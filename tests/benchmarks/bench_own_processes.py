"""The cost of nodes in separate processes: `python tests/benchmarks/bench_own_processes.py [COUNT...]`, JSON out.

Each COUNT is a `bot-console launch` of that many nodes, with a timer of 1 Hz each, in a separate domain. Measures the
wall time until the last node has reported that it is up (`ready_s`), the CPU time of all processes until then
(`cpu_s`), the unshared memory per node (`own_mb`), and the share of a processor that all of them use at rest, including
threads (`idle_share`). Verbs are run meanwhile, with their wall and CPU time (s, medians).
"""

from __future__ import annotations

import contextlib
import json
import os
import re
import resource
import signal
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

COUNTS = (4, 20, 50)
REST_S = 6.0
VERBS = (("node", "list"), ("param", "set", "/n0", "speed", "2.0"), ("topic", "echo", "--once", "/ticks"))
TIMES = 3

NODE = """
import rclpy
from rclpy.executors import ExternalShutdownException
from std_msgs.msg import String

rclpy.init()
node = rclpy.create_node("node")
node.declare_parameter("speed", 1.0)
ticks = node.create_publisher(String, "/ticks", 1)
node.create_timer(1.0, lambda: ticks.publish(String(data="tick")))
print("up", flush=True)
try:
    rclpy.spin(node)
except (KeyboardInterrupt, ExternalShutdownException):
    pass
"""

LAUNCH = """
from launch import LaunchDescription
from launch_ros.actions import Node

def generate_launch_description():
    names = [f"n{{number}}" for number in range({count})]
    return LaunchDescription([Node(executable={node!r}, name=name, output="screen") for name in names])
"""


def tree(root: int) -> Iterator[int]:
    """A process and its descendants."""
    yield root
    children: list[str] = []
    with contextlib.suppress(OSError):  # It has ended.
        for thread in os.listdir(f"/proc/{root}/task"):
            with contextlib.suppress(OSError):
                children += Path(f"/proc/{root}/task/{thread}/children").read_text().split()
    for each in children:
        yield from tree(int(each))


def cpu(pids: Sequence[int]) -> float:
    """CPU time (s) of some processes."""
    total = 0
    for pid in pids:
        fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
        total += int(fields[11]) + int(fields[12])
    return total / os.sysconf("SC_CLK_TCK")


def own_mb(pid: int) -> float:
    """Memory (MB) that a process shares with no other."""
    text = Path(f"/proc/{pid}/smaps_rollup").read_text()
    return sum(int(each) for each in re.findall(r"^Private_\w+:\s+(\d+) kB", text, re.MULTILINE)) / 1000


def verb(words: Sequence[str]) -> tuple[float, float]:
    """Wall and CPU time (s) of a verb."""
    before, began = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    subprocess.run([sys.executable, "-m", "bot_console.tui", *words], check=True, stdout=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.monotonic() - began, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def measured(count: int, folder: Path) -> dict[str, Any]:
    """Measure one launch."""
    node, file = folder / "node.py", folder / f"{count}.launch.py"
    node.write_text(NODE)
    file.write_text(LAUNCH.format(node=str(node), count=count))
    began = time.monotonic()
    line = [sys.executable, "-m", "bot_console.tui", "launch", str(file)]
    started = subprocess.Popen(
        line, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True
    )
    assert started.stdout is not None
    up = 0
    while up < count:
        text = started.stdout.readline()
        assert text, "the launch has ended"
        up += text.rstrip().endswith("up")
    ready = time.monotonic() - began
    pids = list(tree(started.pid))
    spent = cpu(pids)
    nodes = [pid for pid in pids if Path(f"/proc/{pid}/comm").read_text().startswith("node.py")]
    time.sleep(1.0)
    before = cpu(pids)
    time.sleep(REST_S)
    rest = (cpu(pids) - before) / REST_S
    verbs = {" ".join(words[:2]): [verb(words) for _ in range(TIMES)] for words in VERBS}
    own = statistics.median(own_mb(pid) for pid in nodes)
    os.kill(started.pid, signal.SIGINT)
    started.communicate()
    return {
        "processes": len(nodes),
        "ready_s": round(ready, 3),
        "cpu_s": round(spent, 2),
        "own_mb": round(own, 1),
        "idle_share": round(rest, 3),
        "verbs": {
            name: [round(statistics.median(each), 3) for each in zip(*runs, strict=True)]
            for name, runs in verbs.items()
        },
    }


def main() -> None:
    """Measure all counts."""
    counts = [int(each) for each in sys.argv[1:]] or COUNTS
    with tempfile.TemporaryDirectory(dir="/tmp") as folder:
        os.environ["BOT_CONSOLE_SOCKET_DIR"] = f"{folder}/s"
        os.environ["ROS_LOG_DIR"] = f"{folder}/log"
        print(json.dumps({str(count): measured(count, Path(folder)) for count in counts}, indent=2))


if __name__ == "__main__":
    main()
