"""The cost of the screen: `python tests/benchmarks/bench_screen.py [RUNS]`, JSON out. Linux; five minutes a run.

Runs the console with its robot, and a screen of stock Textual widgets with the same kind of data, each in a
pseudo-terminal whose link can be slow. Medians of the runs as [median, minimum, maximum]; ratios are within one run.

first      the first complete frame: bytes, seconds and CPU time (ms, all threads) until then, compared with an app of
           one word; processes that the console has started by then are not counted
start      seconds from the command until parameters, log and robot are on the screen; bytes sent until then
live       bytes and frames per second, percent of a processor (the console's includes robot, nodes and simulator)
keys       milliseconds from a press to the changed screen; `lost` are not answered within 5 s
drawing    percent of a processor that the drawing thread takes, in each pane, with a driving robot
stall      a terminal that reads nothing for 10 s: seconds until the screen is up to date again, bytes that came late,
           seconds until the console ends while stalled
"""

from __future__ import annotations

import json
import os
import random
import re
import statistics
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[1] / "helpers"))

from bot_console.tui.pane_table import PANES
from pty_meter import Link, Terminal

CONSOLE = [sys.executable, "-m", "bot_console.tui"]
STOCK = [sys.executable, str(Path(__file__).with_name("stock_screen.py"))]
TRIVIAL = [sys.executable, str(Path(__file__).with_name("trivial_screen.py"))]
WIDE, NARROW = (120, 40), (80, 24)
LINKS = {
    "local": Link(),
    "1 Mbit/s, 40 ms": Link(125_000, delay=0.02),
    "1 Mbit/s, 150 ms": Link(125_000, delay=0.075),
    "100 kbit/s, 150 ms": Link(12_500, delay=0.075),
}
PARAMETERS, LOG, ROBOT = re.compile("max_speed"), re.compile(r"\d\d:\d\d:\d\d\.\d+ [IWE] "), re.compile("[←↑→↓↖↗↘↙]")
CURSOR = "48;2;43;74;107"
"""The background of the selected row."""
PRESSES = 20
LOST = 4
"""Unanswered keys after which no more are pressed."""


def first_frame(command: list[str]) -> dict[str, float]:
    """The cost until the end of the first frame."""
    terminal = Terminal(command, WIDE, shown=False)
    terminal.run(60, lambda: terminal.frames_ended)
    took, used = time.monotonic() - terminal.began, sum(terminal.threads().values())
    found = {"s": took, "cpu ms": used * 1e3, "bytes": terminal.received}
    terminal.run(1)
    terminal.close()
    return found


def first_frames() -> dict[str, float]:
    """The console's first frame, and its ratio to the smallest Textual app."""
    least, ours = first_frame(TRIVIAL), first_frame(CONSOLE)
    return {
        **ours,
        "cpu ms, trivial": least["cpu ms"],
        "s, console / trivial": ours["s"] / least["s"],
        "cpu, console / trivial": ours["cpu ms"] / least["cpu ms"],
    }


def drawing() -> dict[str, float]:
    """The processor share of the drawing thread, pane by pane; 0 is the overview."""
    terminal = Terminal(CONSOLE, WIDE, shown=False)
    terminal.run(8)
    found: dict[str, float] = {}
    for key in ("0", *(each.key for each in PANES)):
        terminal.press(key)
        terminal.run(2)
        began, before = time.monotonic(), terminal.threads()[terminal.pid]
        terminal.run(5)
        found[key] = 100 * (terminal.threads()[terminal.pid] - before) / (time.monotonic() - began)
    terminal.close()
    return found


def measure_start(options: list[str], size: tuple[int, int], *wanted: re.Pattern[str]) -> dict[str, float]:
    """The time and bytes until all `wanted` texts are on the screen."""
    terminal = Terminal([*CONSOLE, *options], size)
    seen = terminal.run(20, lambda: all(each.search(terminal.text()) for each in wanted))
    found = {"s": time.monotonic() - terminal.began if seen else float("nan"), "bytes": terminal.received}
    terminal.close()
    return found


def live(command: list[str], size: tuple[int, int], warm: float) -> dict[str, float]:
    """The cost of a screen that shows a driving robot."""
    terminal = Terminal(command, size, shown=False)
    terminal.run(warm)
    began, cpu, received, frames = time.monotonic(), terminal.cpu(), terminal.received, terminal.frames
    terminal.run(5)
    span = time.monotonic() - began
    found = {
        "bytes/s": (terminal.received - received) / span,
        "frames/s": (terminal.frames - frames) / span,
        "cpu %": 100 * (terminal.cpu() - cpu) / span,
    }
    terminal.close()
    return found


def keys(command: list[str], link: Link, pressed: str, shown: Callable[[Terminal], object]) -> dict[str, float]:
    """The response times of keys pressed in turn."""
    terminal = Terminal(command, WIDE, link)
    terminal.run(5)
    took: list[float] = []
    lost = 0
    while len(took) + lost < PRESSES and lost < LOST:
        before, began = shown(terminal), time.monotonic()
        terminal.press(pressed[(len(took) + lost) % len(pressed)])
        if terminal.run(5, lambda before=before: shown(terminal) != before):
            took.append((time.monotonic() - began) * 1e3)
        else:
            lost += 1
        terminal.run(random.uniform(0.1, 0.3))
    terminal.close()
    took.sort()
    return {"p50": _percentile(took, 0.5), "p99": _percentile(took, 0.99), "lost %": 100 * lost / (len(took) + lost)}


def stalled() -> dict[str, float]:
    """A terminal that stops reading, reads again, and stops before the end."""
    terminal = Terminal(CONSOLE, WIDE)
    terminal.run(6)
    terminal.reading = False
    terminal.run(10)
    terminal.reading, before, began = True, terminal.received, time.monotonic()
    at = cursor(terminal)
    terminal.press("j")
    terminal.run(70, lambda: cursor(terminal) != at)
    found = {"until up to date, s": time.monotonic() - began, "late bytes": terminal.received - before}
    terminal.reading = False
    terminal.run(5)
    found["end, s"] = terminal.close()
    return found


def cursor(terminal: Terminal) -> object:
    """The lines that have the cursor's background."""
    cells = terminal.screen.cells if terminal.screen else []
    return [y for y, row in enumerate(cells) if any(CURSOR in style for _, style in row)]


def counted(terminal: Terminal) -> object:
    """The number of keys counted by the stock screen."""
    return re.findall(r"K(\d+)#", terminal.text())


def run() -> dict[str, Any]:
    found: dict[str, Any] = {
        "first": first_frames(),
        "start 120x40": measure_start([], WIDE, PARAMETERS, LOG, ROBOT),
        "start 80x24, parameters": measure_start([], NARROW, PARAMETERS),
        "start 80x24, log": measure_start(["--pane", "logs"], NARROW, LOG),
        "start 80x24, robot": measure_start(["--pane", "world"], NARROW, ROBOT),
        "live 120x40": live(CONSOLE, WIDE, 6),
        "live 80x24": live(CONSOLE, NARROW, 6),
        "live 120x40, stock": live(STOCK, WIDE, 2),
    }
    ours, stock = found["live 120x40"], found["live 120x40, stock"]
    found["ratios"] = {
        "bytes, stock / console": stock["bytes/s"] / ours["bytes/s"],
        "cpu, console / stock": ours["cpu %"] / stock["cpu %"],
    }
    for name, link in LINKS.items():
        found[f"keys {name}"] = keys(CONSOLE, link, "jk", cursor)
    found["keys 1 Mbit/s, 40 ms, stock"] = keys(STOCK, LINKS["1 Mbit/s, 40 ms"], "j", counted)
    found["drawing"] = drawing()
    found["stall"] = stalled()
    return found


def _percentile(values: list[float], share: float) -> float:
    return values[min(len(values) - 1, int(share * len(values)))] if values else float("nan")


def summary(runs: list[dict[str, Any]]) -> dict[str, Any]:
    """Median, minimum and maximum of every figure."""
    return {
        name: {
            figure: [round(pick([each[name][figure] for each in runs]), 3) for pick in (statistics.median, min, max)]
            for figure in runs[0][name]
        }
        for name in runs[0]
    }


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as home:
        os.environ["HOME"] = home  # Ignores the settings of the person who runs this.
        runs = [run() for _ in range(int(sys.argv[1]) if len(sys.argv) > 1 else 3)]
    print(json.dumps(summary(runs), indent=2))
