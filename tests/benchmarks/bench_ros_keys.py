"""Typing beside a busy rclpy: `REAL_PYTHON tests/benchmarks/bench_ros_keys.py [RUNS]`, JSON out. Linux.

REAL_PYTHON has the project and a real rclpy, such as the one of `pip install 'bot-console[ros-jazzy]'`. A robot in a
separate process logs 1,000 lines per second and publishes odometry, scans and 18 other topics at 50 Hz; a console
attached to it (`attach --ros`) records the log, draws it, and follows the robot for panes that are not shown. Its load
includes the decoding of these messages by rclpy, which holds the interpreter lock. A run takes about a minute, mostly
pauses between keys; stderr says which part of which run has begun.

quiet, busy    milliseconds from a press to the character on the screen, in the search of the log: median, 95th
               percentile, maximum; before and while the robot works
busy / quiet   their ratio within one run, for comparison between machines
lost           keys whose character does not appear within 5 s; after three of them the part is given up
lines/s        log lines that the console has recorded: fewer than 1,000 where the machine is too busy for the robot
load           processes that waited for a processor in the last minute, before the run: expect noise above 1
"""

from __future__ import annotations

import json
import os
import re
import signal
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "helpers"))

from pty_meter import Terminal

CONSOLE = [sys.executable, "-m", "bot_console.tui", "attach", "--ros", "--pane", "logs"]
SIZE = (120, 40)
TEXT = "abcdefghijklmnopqrstuvwxyz0123456789"
TIMES = 3
"""How often the text is typed in each part; each character waits for the previous one and a pause."""
PAUSE_S = 0.13
START_TIMEOUT_S, KEY_TIMEOUT_S, SETTLE_S = 60.0, 5.0, 5.0
MAX_LOST_KEYS = 3
DOMAIN = "97"
ROBOT = """
import contextlib, signal, time
import rclpy
from nav_msgs.msg import Odometry
from rcl_interfaces.msg import Log
from rclpy.executors import ExternalShutdownException
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Float64
rclpy.init()
node = rclpy.create_node("busy")
publishers = [node.create_publisher(Float64, f"level_{number}", 10) for number in range(18)]
odometry, scans = node.create_publisher(Odometry, "odom", 10), node.create_publisher(LaserScan, "scan", 10)
odometry_message, scan, level = Odometry(), LaserScan(ranges=[1.0] * 360), Float64(data=0.5)
latched = QoSProfile(depth=1000, durability=DurabilityPolicy.TRANSIENT_LOCAL)
log_lines = node.create_publisher(Log, "/rosout", latched)  # a logger would also write files
line = Log(level=20, name="busy", file="busy.py", function="log", line=1)
working, lines = [], [0]
signal.signal(signal.SIGUSR1, lambda *_: working.append(time.monotonic()))

def log():
    line.stamp = node.get_clock().now().to_msg()
    while working and lines[0] < 1000 * (time.monotonic() - working[0]):
        lines[0] += 1
        line.msg = f"cycle {lines[0]}: the speed is 0.5 m/s"
        log_lines.publish(line)

def publish():
    if working:
        now = node.get_clock().now().to_msg()
        odometry_message.header.stamp = scan.header.stamp = now
        odometry.publish(odometry_message)
        scans.publish(scan)
        for each in publishers:
            each.publish(level)

node.create_timer(0.01, log)
node.create_timer(0.02, publish)

def greet():
    if log_lines.get_subscription_count():  # a line from before would expire if the console found the robot late
        greeting.cancel()
        line.msg, line.stamp = "ready to work", node.get_clock().now().to_msg()
        log_lines.publish(line)

greeting = node.create_timer(0.1, greet)
with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException):
    rclpy.spin(node)
"""


def type_text(terminal: Terminal) -> dict[str, float]:
    """Type the text into the search of the log."""
    took: list[float] = []
    for _ in range(TIMES):
        terminal.press("/")
        terminal.run(1.0)
        for count in range(1, len(TEXT) + 1):
            terminal.run(PAUSE_S)
            began = time.monotonic()
            terminal.press(TEXT[count - 1])
            seen = terminal.run(KEY_TIMEOUT_S, lambda count=count: TEXT[:count] in terminal.text())
            took.append((time.monotonic() - began) * 1e3 if seen else float("nan"))
            if sum(each != each for each in took) == MAX_LOST_KEYS:
                return summary(took)
        terminal.press("\x1b")
        terminal.run(1.0)
    return summary(took)


def recorded_lines(terminal: Terminal) -> int:
    """The number of lines in the console's log, as its pane shows it."""
    found = re.search(r" of ([\d,]+) ·", terminal.text())
    return int(found[1].replace(",", "")) if found else 0


def summary(took: Sequence[float]) -> dict[str, float]:
    """The percentiles (ms) of the answered keys."""
    answered = sorted(each for each in took if each == each)
    if len(answered) < 2:
        return {"lost": len(took)}
    found = {"p50": statistics.median(answered), "p95": statistics.quantiles(answered, n=20)[-1], "max": answered[-1]}
    return {name: round(value, 1) for name, value in found.items()} | {"lost": len(took) - len(answered)}


def run(report: Callable[[str], None]) -> dict[str, object]:
    """One run; `report` receives the name of each part before it begins."""
    report("start")
    load = round(os.getloadavg()[0], 1)
    terminal = Terminal(CONSOLE, SIZE)
    with subprocess.Popen([sys.executable, "-c", ROBOT], stderr=subprocess.DEVNULL) as robot:
        try:
            assert terminal.run(START_TIMEOUT_S, lambda: "ready to work" in terminal.text()), terminal.text()
            report("quiet")
            terminal.run(SETTLE_S)
            quiet = type_text(terminal)
            report("busy")
            robot.send_signal(signal.SIGUSR1)
            terminal.run(SETTLE_S)
            used, lines, began = terminal.cpu(), recorded_lines(terminal), time.monotonic()
            busy = type_text(terminal)
            took = time.monotonic() - began
            used, lines = terminal.cpu() - used, recorded_lines(terminal) - lines
        finally:
            terminal.close()
            robot.kill()
    ratio = round(busy["p95"] / quiet["p95"], 2) if "p95" in busy and "p95" in quiet else None
    return {
        "load": load,
        "quiet": quiet,
        "busy": busy,
        "busy / quiet": ratio,
        "lines/s": round(lines / took),
        "console cpu %": round(100 * used / took),
    }


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        os.environ.update(
            ROS_DOMAIN_ID=DOMAIN, ROS_AUTOMATIC_DISCOVERY_RANGE="LOCALHOST",
            BOT_CONSOLE_USER_DIR=folder, ROS_LOG_DIR=folder,
        )  # fmt: skip
        runs = int(sys.argv[1]) if len(sys.argv) > 1 else 3

        def reporter(number: int) -> Callable[[str], None]:
            return lambda part: print(f"run {number} of {runs}: {part}", file=sys.stderr, flush=True)

        print(json.dumps([run(reporter(number)) for number in range(1, runs + 1)], indent=2))


if __name__ == "__main__":
    main()
