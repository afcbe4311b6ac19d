"""Stepped runs beside busy processes: each must report, and all of one system must report the same.

    python tests/soak/headless_under_load.py --runs 200 --busy 16 --system robot

Prints one JSON object: how many runs there were, and how many ended how. `--nice` applies to the runs and to the busy
processes, so that a shared machine stays usable. The systems are our robot, the course's package `intelligent_robot`
with a simulator (`BOT_CONSOLE_COURSE` names the course), and our robot with two programs of a user, one of which is
aborted by its C code after 5 s.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Generator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from typing import Any

BUSY = "while True: pass"
TIMEOUT_S = 300.0
"""Seconds after which a run is given up and its processes print their stacks; nothing is measured by it."""
STACKS_S = 10.0
"""Seconds that a process has to print its stacks."""

PACKAGE_XML = (
    "<package format='3'><name>intelligent_robot</name><version>0.0.1</version><description>robot</description>"
    "<maintainer email='a@b.c'>a</maintainer><license>MIT</license>"
    "<export><build_type>ament_python</build_type></export></package>"
)
COURSE_LAUNCH = """
from launch import LaunchDescription
from launch_ros.actions import Node

def generate_launch_description():
    return LaunchDescription([Node(package='intelligent_robot', executable='robot_node', output='screen')])
"""
ABORTED_LAUNCH = """
from pathlib import Path
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch_ros.actions import Node

def generate_launch_description():
    robot = Path(get_package_share_directory('bot_console_robot'), 'launch', 'robot_system.launch.py')
    programs = sorted(Path(__file__).parent.glob('*_program.py'))
    return LaunchDescription([IncludeLaunchDescription(str(robot)),
                              *(Node(executable=str(each), output='screen') for each in programs)])
"""
ABORTED = """#!/usr/bin/env python3
import ctypes
import rclpy
from rclpy.node import Node
from sensor_msgs.msg import LaserScan

class Aborted(Node):
    def __init__(self):
        super().__init__('aborted')
        self.create_subscription(LaserScan, 'scan', lambda scan: None, 10)
        self.create_timer(5.0, lambda: ctypes.CDLL(None).abort())

rclpy.init()
rclpy.spin(Aborted())
"""
DRIVING = """#!/usr/bin/env python3
import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node

class Driving(Node):
    def __init__(self):
        super().__init__('driving')
        self.publisher = self.create_publisher(Twist, 'cmd_vel_teleop', 10)
        self.create_timer(0.2, self.drive)

    def drive(self):
        command = Twist()
        command.linear.x, command.angular.z = 0.2, 0.3
        self.publisher.publish(command)

rclpy.init()
rclpy.spin(Driving())
"""


@contextmanager
def busy_processes(count: int) -> Generator[None]:
    """Run `count` processes that only compute, for the length of the block."""
    started = [subprocess.Popen([sys.executable, "-c", BUSY]) for _ in range(count)]
    try:
        yield
    finally:
        for each in started:
            each.kill()
            each.wait()


def robot(_folder: Path) -> list[str]:
    """Our robot alone."""
    return []


def course(folder: Path) -> list[str]:
    """The course's package with our simulator."""
    package = folder / "src" / "intelligent_robot"
    (package / "resource").mkdir(parents=True)
    (package / "resource" / "intelligent_robot").touch()
    (package / "package.xml").write_text(PACKAGE_XML)
    given = Path(os.environ["BOT_CONSOLE_COURSE"])
    shutil.copyfile(given / "setup.py.txt", package / "setup.py")
    shutil.copytree(given / "nodes" / "intelligent_robot", package / "intelligent_robot")
    (package / "intelligent_robot" / "__init__.py").touch()
    (folder / "course.launch.py").write_text(COURSE_LAUNCH)
    return ["--workspace", str(folder), "--launch", str(folder / "course.launch.py"), "--simulator"]


def aborted(folder: Path) -> list[str]:
    """Our robot, a program that drives it, and one that is aborted by its C code after 5 s."""
    for name, text in (("aborted", ABORTED), ("driving", DRIVING)):
        program = folder / f"{name}_program.py"
        program.write_text(text)
        program.chmod(0o755)
    (folder / "aborted.launch.py").write_text(ABORTED_LAUNCH)
    return ["--launch", str(folder / "aborted.launch.py")]


SYSTEMS = {each.__name__: each for each in (robot, course, aborted)}


def run(words: list[str]) -> str:
    """The outcome of one run: its report, or its last output."""
    line = [
        sys.executable,
        "-X",
        "faulthandler",
        "-m",
        "bot_console.tui",
        "--headless",
        "--fast",
        "--seed",
        "1",
        *words,
    ]
    env = {**os.environ, "PYTHONHASHSEED": str(random.randrange(1 << 32))}
    with subprocess.Popen(
        line, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=env, start_new_session=True
    ) as started:
        try:
            out, error = started.communicate(timeout=TIMEOUT_S)
        except subprocess.TimeoutExpired:
            return f"hangs:\n{stacks(started)}"
    if started.returncode:
        return f"exit code {started.returncode}: {error[-1000:]}"
    report: dict[str, Any] = json.loads(out)
    del report["wall_time"]
    return json.dumps(report, sort_keys=True)


def stacks(hanging: subprocess.Popen[str]) -> str:
    """End a process that hangs; returns what it has printed, and the stacks of its threads and its children's."""
    found: list[str] = []
    if spy := shutil.which("py-spy"):
        looked = subprocess.run(
            [spy, "dump", "--subprocesses", "--pid", str(hanging.pid)], capture_output=True, text=True, check=False
        )
        found.append(looked.stdout + looked.stderr)
    os.killpg(hanging.pid, signal.SIGABRT)
    try:
        found.append(hanging.communicate(timeout=STACKS_S)[1])
    except subprocess.TimeoutExpired:
        os.killpg(hanging.pid, signal.SIGKILL)
        found.append(hanging.communicate()[1])
    return "\n".join(found)


def outcomes(runs: int, busy: int, seconds: float = 15.0, system: str = "robot") -> Counter[str]:
    """The outcomes of the runs with their counts, printed on stderr as runs end; one run per processor at a time."""
    ended: Counter[str] = Counter()
    with tempfile.TemporaryDirectory() as folder, busy_processes(busy), ThreadPoolExecutor(os.cpu_count()) as pool:
        words = [*SYSTEMS[system](Path(folder)), "--duration", str(seconds)]
        for outcome in pool.map(run, [words] * runs):
            if outcome not in ended:
                print(outcome, file=sys.stderr)
            ended[outcome] += 1
            print(f"{system}: {ended.total()} of {runs} runs, {len(ended)} outcomes", file=sys.stderr, flush=True)
    return ended


def main() -> None:
    """Run with the command line's options."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--runs", type=int, default=200)
    parser.add_argument("--busy", type=int, default=16)
    parser.add_argument("--seconds", type=float, default=15.0)
    parser.add_argument("--system", choices=SYSTEMS, default="robot")
    parser.add_argument("--nice", type=int, default=0)
    options = parser.parse_args()
    os.nice(options.nice)
    ended = outcomes(options.runs, options.busy, options.seconds, options.system)
    print(json.dumps({"runs": options.runs, "outcomes": len(ended), "ended": ended}, indent=2))


if __name__ == "__main__":
    main()
