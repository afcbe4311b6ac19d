"""The cost of the live system: `python tests/benchmarks/bench_live.py [--program BOT_CONSOLE ...]`, JSON lines. Linux.

Shares of a processor that a program uses with all its processes, over some seconds each: the robot without a console;
the robot with a console attached, and that console (with the bytes per second that it sends and its memory); and a
console with its own robot. `shares` are as measured; `normal` are converted to a machine on which the plain Python loop
(`plain_loop.py`), timed before and after, takes as long as when the shares in the documentation were first measured.
With several `--program`, such as `OTHER_CHECKOUT/.venv/bin/bot-console`, they alternate.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

HELPERS = Path(__file__).parents[1] / "helpers"
sys.path.insert(0, str(HELPERS))
from bench_own_processes import cpu, tree
from plain_loop import REFERENCE_S, loop_s
from pty_meter import Terminal

SIZE = (120, 40)
START_TIMEOUT_S = 200.0
SETTLE_S = 5.0


def cpu_s(root: int) -> float:
    """CPU time (s) of a process and its living descendants."""
    return cpu([*tree(root)])


def memory_mb(root: int) -> float:
    """Memory (MB) of a process and its descendants; shared memory counts once."""
    texts = (Path(f"/proc/{pid}/smaps_rollup").read_text() for pid in tree(root))
    return sum(int(each) for text in texts for each in re.findall(r"^Pss:\s+(\d+) kB", text, re.MULTILINE)) / 1000


def shares(roots: Sequence[int], seconds: float, pause: Callable[[float], object]) -> list[float]:
    """The share of a processor that each process tree uses meanwhile."""
    began, before = time.monotonic(), [cpu_s(each) for each in roots]
    pause(seconds)
    passed = time.monotonic() - began
    return [(cpu_s(each) - start) / passed for each, start in zip(roots, before, strict=True)]


def open_console(line: Sequence[str]) -> Terminal:
    """A console in a terminal, as soon as it shows the robot's nodes."""
    terminal = Terminal(line, SIZE)
    assert terminal.run(START_TIMEOUT_S, lambda: "robot_navigator" in terminal.text()), terminal.text()
    terminal.run(SETTLE_S)
    return terminal


def measure_in_background(program: Sequence[str], seconds: float) -> dict[str, float]:
    """Measure the robot alone, and with a console attached."""
    started = subprocess.run([*program, "up", "--seed", "1"], check=True, capture_output=True, text=True)
    found = re.search(r"process (\d+)", started.stdout)
    assert found, started.stdout
    robot = int(found[1])
    try:
        time.sleep(SETTLE_S)
        (alone,) = shares([robot], seconds, time.sleep)
        console = open_console([*program, "attach"])
        try:
            received = console.received
            beside, attached = shares([robot, console.pid], seconds, console.run)
            figures = {"bytes_per_s": (console.received - received) / seconds, "console_mb": memory_mb(console.pid)}
        finally:
            console.close()
    finally:
        subprocess.run([*program, "down"], check=True, capture_output=True)
    return {"robot": alone, "robot_beside_console": beside, "attached_console": attached, **figures}


def measure_with_console(program: Sequence[str], seconds: float) -> dict[str, float]:
    """Measure a console with its own robot."""
    console = open_console([*program, "--seed", "1"])
    try:
        (share,) = shares([console.pid], seconds, console.run)
        return {"together": share, "together_mb": memory_mb(console.pid)}
    finally:
        console.close()


def measured(program: Sequence[str], seconds: float) -> dict[str, Any]:
    """All figures of a program, in separate folders."""
    with tempfile.TemporaryDirectory(prefix="bl", dir="/tmp") as folder:
        places = {"XDG_STATE_HOME": "state", "XDG_CONFIG_HOME": "config", "BOT_CONSOLE_SOCKET_DIR": "s"}
        os.environ.update({name: os.path.join(folder, place) for name, place in places.items()})
        os.environ["BOT_CONSOLE_USER_DIR"] = os.path.join(folder, "u")
        os.chdir(folder)
        loop = loop_s()
        figures = {**measure_in_background(program, seconds), **measure_with_console(program, seconds)}
        loop = (loop + loop_s()) / 2
        os.chdir("/")
    others = {name: figures.pop(name) for name in ("bytes_per_s", "console_mb", "together_mb")}
    return {
        "loop_s": round(loop, 3),
        "shares": {name: round(each, 4) for name, each in figures.items()},
        "normal": {name: round(each * REFERENCE_S / loop, 4) for name, each in figures.items()},
        **{name: round(each, 1) for name, each in others.items()},
    }


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description="Shares of a processor of the live system.")
    parser.add_argument("--program", action="append", help="another bot-console, to be compared; may be repeated")
    parser.add_argument("--seconds", type=float, default=30.0)
    parser.add_argument("--repeats", type=int, default=3)
    given = parser.parse_args()
    programs = [[os.path.abspath(each)] for each in given.program or ()] or [[sys.executable, "-m", "bot_console.tui"]]
    for _ in range(given.repeats):
        for program in programs:
            print(json.dumps({"program": program[0], **measured(program, given.seconds)}), flush=True)


if __name__ == "__main__":
    main()
