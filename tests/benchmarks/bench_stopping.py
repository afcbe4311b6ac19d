"""Wall time from the byte in the terminal until the base acknowledges that it is locked, as JSON.

    python tests/benchmarks/bench_stopping.py [--presses 50] [--floods 5] [--busy 2] [--only logs plot]
        [--wanted-nice -10]

A console attached to a live robot, in separate processes, is driven over a pseudo-terminal; another process receives
the base's answer. Wall time in ms: median, 99th percentile and maximum over all presses of `!`, alone, beside loads and
behind floods of input, and of the first key and of `q` in new consoles. `--wanted-nice` is the priority of everything
that is measured, for shared machines; busy processes have the usual one.
"""

from __future__ import annotations

import argparse
import contextlib
import fcntl
import json
import os
import shutil
import statistics
import struct
import subprocess
import sys
import tempfile
import termios
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

TESTS = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS / "helpers"), str(TESTS / "acceptance" / "console"), str(TESTS / "soak")]
from headless_under_load import busy_processes
from processes.live_robot import LiveRobot, live_robot
from processes.losses import _environment
from terminal import Terminal

HEARD = """
import time
import rclpy
from diagnostic_msgs.msg import DiagnosticStatus
from rclpy.qos import DurabilityPolicy, QoSProfile

rclpy.init()
node = rclpy.create_node("hears_the_base")
def tell(message):
    locked = {each.key: each.value for each in message.values}["locked"]
    print(time.monotonic(), locked, flush=True)
latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
node.create_subscription(DiagnosticStatus, "emergency_stop/base", tell, latched)
rclpy.spin(node)
"""
NODES = """
import rclpy
rclpy.init()
nodes = [rclpy.create_node(f"n{number}") for number in range(500)]
rclpy.spin(nodes[0])
"""
TOPICS = """
import rclpy
from std_msgs.msg import String
rclpy.init()
node = rclpy.create_node("many_topics")
publishers = [node.create_publisher(String, f"topic{number}", 10) for number in range(3000)]
rclpy.spin(node)
"""
LOGS = """
import rclpy
rclpy.init()
node = rclpy.create_node("logs")
def tell():
    for number in range(100):
        node.get_logger().info(f"line {number} of a hundred, with aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa")
node.create_timer(0.01, tell)
rclpy.spin(node)
"""
NUMBERS = """
import math
import rclpy
from std_msgs.msg import Float64
rclpy.init()
node = rclpy.create_node("numbers")
publisher = node.create_publisher(Float64, "number", 1000)
count = 0
def tell():
    global count
    for _ in range(10):
        count += 1
        publisher.publish(Float64(data=math.sin(count / 100)))
node.create_timer(0.01, tell)
rclpy.spin(node)
"""
LOADS: dict[str, tuple[str, list[str]]] = {
    "nothing": ("", []),
    "500 nodes at once": (NODES, []),
    "3,000 topics": (TOPICS, []),
    "10,000 log lines/s": (LOGS, ["2"]),
    "1,000 messages/s plotted": (NUMBERS, ["4", "a", "/number/data", "\r"]),
    "endless regular expression": (LOGS, ["2", "/", "re:(.|\\w)*%%", "\r"]),
}
"""A program that makes the load, and the keys that are pressed once it runs."""
PASTE = "\x1b[200~" + "text with a ! in it, " * 1500 + "\x1b[201~"
MOVES = [f"\x1b[<35;{10 + at % 90};{5 + at % 30}M" for at in range(15_000)]
WHEEL = ["\x1b[<65;60;20M"] * 2_000
FLOODS: dict[str, tuple[list[str], float, int]] = {
    "900 moves of a mouse at a hand's pace": (MOVES[:900], 0.005, 0),
    "15,000 moves and 300 resizes": (MOVES, 0.0, 50),
    "2,000 steps of a wheel": (WHEEL, 0.0, 0),
    "200 keys of all kinds": ([*"12345678?\x1bjkgG" * 14], 0.0, 0),
    "a paste of 30 kB": ([PASTE], 0.0, 0),
}
"""The input before the key, the seconds between two inputs, and after how many of them the terminal is resized."""
TIMEOUT_S = 60.0
BETWEEN = 0.15
"""Seconds between two presses."""
MORE = 5
"""How often a release may be pressed again."""


class Base:
    """The state of the base's lock, as received by another process."""

    def __init__(self, robot: LiveRobot) -> None:
        self._states: list[tuple[float, bool]] = []
        process = robot.program(HEARD, stdout=subprocess.PIPE)
        threading.Thread(target=self._read, args=(process,), daemon=True).start()

    def _read(self, process: subprocess.Popen[bytes]) -> None:
        assert process.stdout is not None
        for line in process.stdout:
            moment, locked = line.split()
            self._states.append((float(moment), locked == b"true"))

    @property
    def locked(self) -> bool:
        """Whether it is locked, by its last report."""
        return bool(self._states) and self._states[-1][1]

    def message_of(self, locked: bool, since: float) -> float | None:
        """When it first reported that state after `since`; None if it has not."""
        return next((moment for moment, state in list(self._states) if moment >= since and state is locked), None)


@contextlib.contextmanager
def console(robot: LiveRobot) -> Iterator[Terminal]:
    """A console whose output is read all the time."""
    with _environment(robot.environment):
        terminal = Terminal(robot.attach, robot.folder)
    over = threading.Event()

    def read() -> None:
        while not over.is_set():
            terminal.drain(0.02)

    reader = threading.Thread(target=read, daemon=True)
    reader.start()
    try:
        wait(lambda: b"robot_navigator" in terminal.output)
        yield terminal
    finally:
        over.set()
        reader.join()
        terminal.close()


def wait(true: Callable[[], Any], timeout_s: float = TIMEOUT_S) -> Any:
    """Wait until `true` returns a truthy value, and return it; None after the timeout."""
    deadline = time.monotonic() + timeout_s
    while time.monotonic() < deadline:
        if found := true():
            return found
        time.sleep(0.001)
    return None


def presses(robot: LiveRobot, base: Base, load: str, count: int) -> dict[str, Any]:
    """Press `!` repeatedly beside a load."""
    program, keys = LOADS[load]
    stops: list[float] = []
    releases: list[float] = []
    lost = {"stop": 0, "release": 0}
    again = 0
    with console(robot) as terminal:
        loading = robot.program(program) if program else None
        for each in keys:
            time.sleep(0.5)
            terminal.type(each)
        for _ in range(count):
            for times, locked in ((stops, True), (releases, False)):
                taken, extra = press(terminal, base, locked)
                again += extra
                if taken is None:
                    lost["stop" if locked else "release"] += 1
                else:
                    times.append(taken)
                time.sleep(BETWEEN)
        if loading is not None:
            loading.kill()
            loading.wait()
    robot.run_cli("release", "--all")
    return summary(stops) | {"release": summary(releases), "lost": lost, "pressed again": again}


def press_behind_flood(robot: LiveRobot, base: Base, flood: str, count: int) -> dict[str, Any]:
    """Press `!` repeatedly right behind a flood of input, each time on a robot that is not held."""
    pieces, pause, resized = FLOODS[flood]
    times: list[float] = []
    lost = 0
    with console(robot) as terminal:
        for _ in range(count):
            for number, each in enumerate(pieces):
                terminal.type(each)
                if pause:
                    time.sleep(pause)
                if resized and number % resized == 0:
                    size = struct.pack("HHHH", 40 - number // resized % 2, 120 - number // resized % 7, 0, 0)
                    fcntl.ioctl(terminal.master, termios.TIOCSWINSZ, size)
            taken, _ = press(terminal, base, locked=True, timeout_s=TIMEOUT_S)
            if taken is None:
                lost += 1
            else:
                times.append(taken)
            time.sleep(1.0)  # The key may still be waiting for its turn.
            while base.locked:
                robot.run_cli("release", "--all")
                wait(lambda: not base.locked, 5.0)
    return summary(times) | {"lost": lost}


def press(terminal: Terminal, base: Base, locked: bool, timeout_s: float = 10.0) -> tuple[float | None, int]:
    """Press `!` until the base is locked or released as wanted.

    Returns the ms from the last press (None if the state was never reached) and the number of extra presses. A console
    that
    has not received a stop's acknowledgement sends the stop again instead of releasing, so a release may take a second
    press. A stop may not.
    """
    for extra in range(1 if locked else 1 + MORE):
        began = time.monotonic()
        terminal.type("!")
        answered = wait(lambda: base.message_of(locked, began), timeout_s if locked else 5.0)  # noqa: B023 # called here alone
        if answered is not None:
            return (answered - began) * 1000, extra
    return None, extra


def first_key_and_quit(robot: LiveRobot, count: int) -> dict[str, Any]:
    """Measure the first key of a new console until its effect is on the screen, and `q` until the process has ended."""
    first: list[float] = []
    last: list[float] = []
    for _ in range(count):
        with console(robot) as terminal:
            before, began = len(terminal.output), time.monotonic()
            terminal.type("?")
            if wait(lambda: b"Help" in terminal.output[before:]):  # noqa: B023
                first.append((time.monotonic() - began) * 1000)
            terminal.type("\x1b")
            time.sleep(0.3)
            began = time.monotonic()
            terminal.type("q")
            if wait(lambda: terminal.process.poll() is not None):
                last.append((time.monotonic() - began) * 1000)
    return {"first key": summary(first), "quit": summary(last)}


def prefer(nice: int) -> None:
    """Set the priority of everything that this program starts from now on, session by session.

    Linux first shares processors among the sessions of terminals (`sched_autogroup_enabled`), and every program here
    has a
    separate session, so a priority within one would change nothing.
    """
    os.nice(nice)
    known: set[str] = {str(os.getpid())}
    while True:
        for each in Path("/proc").glob("[0-9]*"):
            if each.name not in known and _is_below(each, known):
                known.add(each.name)
                with contextlib.suppress(OSError):
                    (each / "autogroup").write_text(str(nice))
        time.sleep(0.1)


def _is_below(process: Path, known: set[str]) -> bool:
    with contextlib.suppress(OSError):
        return (process / "stat").read_text().rpartition(")")[2].split()[1] in known
    return False


def summary(times: list[float]) -> dict[str, Any]:
    """Median, 99th percentile and maximum."""
    if not times:
        return {"count": 0}
    ordered = sorted(times)
    p99 = ordered[min(len(ordered) - 1, int(len(ordered) * 0.99))]
    return {"count": len(times), "p50": round(statistics.median(times), 1), "p99": round(p99, 1),
            "longest": round(ordered[-1], 1)}  # fmt: skip


def main() -> None:
    """Run with the command line's options."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--presses", type=int, default=50)
    parser.add_argument("--floods", type=int, default=5, help="presses behind each flood")
    parser.add_argument("--consoles", type=int, default=10, help="for the first key and q")
    parser.add_argument("--busy", type=int, default=0)
    parser.add_argument("--only", nargs="*", default=[], help="words of the names of loads")
    parser.add_argument("--wanted-nice", type=int, default=0)
    options = parser.parse_args()
    folder, sockets = Path(tempfile.mkdtemp()), Path(tempfile.mkdtemp(prefix="bcs"))
    report: dict[str, Any] = {"busy": options.busy, "load average": os.getloadavg()[0], "stop (ms)": {}}
    try:
        with busy_processes(options.busy):
            if options.wanted_nice:
                threading.Thread(target=prefer, args=(options.wanted_nice,), daemon=True).start()
            with live_robot(folder, sockets) as robot:
                base = Base(robot)
                wait(lambda: base.message_of(False, 0.0))
                for load in LOADS:
                    if not options.only or any(word in load for word in options.only):
                        report["stop (ms)"][load] = presses(robot, base, load, options.presses)
                        print(load, report["stop (ms)"][load], file=sys.stderr, flush=True)
                report["stop behind a flood (ms)"] = behind = {}
                for flood in FLOODS:
                    if options.floods and (not options.only or any(word in flood for word in options.only)):
                        behind[flood] = press_behind_flood(robot, base, flood, options.floods)
                        print(flood, behind[flood], file=sys.stderr, flush=True)
                if options.consoles:
                    report |= first_key_and_quit(robot, options.consoles)
    finally:
        for each in (folder, sockets):
            shutil.rmtree(each, ignore_errors=True)
    print(json.dumps(report, indent=2))


if __name__ == "__main__":
    main()
