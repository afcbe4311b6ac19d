"""The cost of keeping and recording: `python tests/benchmarks/bench_bags.py [SECONDS]`, JSON out. Linux; four minutes.

Runs the default robot and its console in a pseudo-terminal of 120x40. Measures the percentage of a processor that
console, nodes and simulator use together while nothing is kept, while the last minutes are kept (`Z`), and while all
topics are recorded as well (`R`). Each is the mean of two alternating runs; `more` is the difference to keeping
nothing.
"""

from __future__ import annotations

import json
import os
import statistics
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "helpers"))

from pty_meter import Terminal

CONSOLE = [sys.executable, "-m", "bot_console.tui"]
SIZE = (120, 40)
WARM = 8.0
MAX_SECONDS = 60.0
RUNS = 2
WAYS = {"nothing": (0, False), "kept": (2, False), "kept and recorded": (2, True)}
"""Minutes that are kept, and whether a bag is recorded."""


def cost(minutes: int, recorded: bool, seconds: float) -> float:
    """Percent of a processor."""
    with tempfile.TemporaryDirectory(prefix="bc-", dir="/tmp") as folder:
        os.environ["BOT_CONSOLE_SOCKET_DIR"] = os.path.join(folder, "s")
        os.environ["BOT_CONSOLE_USER_DIR"] = os.path.join(folder, "u")
        settings = Path(folder, "u", "config", "settings.yaml")
        settings.parent.mkdir(parents=True)
        settings.write_text(f"keep_minutes: {minutes}\n")
        terminal = Terminal(CONSOLE, SIZE)
        terminal.run(MAX_SECONDS, lambda: "actual" in terminal.text())
        terminal.run(WARM)
        if recorded:
            terminal.press("R")
            terminal.run(MAX_SECONDS, lambda: "record all topics" in terminal.text())
            for key in ("\x15", os.path.join(folder, "bag"), "\r"):
                terminal.press(key)
                terminal.run(1.0)
        began, cpu = time.monotonic(), _cpu(terminal.pid)
        terminal.run(seconds)
        share = 100 * (_cpu(terminal.pid) - cpu) / (time.monotonic() - began)
        if recorded and not Path(folder, "bag").is_dir():
            raise SystemExit("nothing was recorded:\n" + terminal.text())
        terminal.close()
    return share


def _cpu(root: int) -> float:
    """Processor time (s) of a process and its descendants."""
    used = 0.0
    for pid in _tree(root):
        with open(f"/proc/{pid}/stat", "rb") as file:
            fields = file.read().rpartition(b")")[2].split()
        used += (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
    return used


def _tree(root: int) -> Iterator[int]:
    yield root
    for task in Path(f"/proc/{root}/task").iterdir():
        for child in (task / "children").read_text().split():
            yield from _tree(int(child))


def main() -> None:
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 30.0
    found: dict[str, list[float]] = {name: [] for name in WAYS}
    for _ in range(RUNS):
        for name, (minutes, recorded) in WAYS.items():
            found[name].append(cost(minutes, recorded, seconds))
    means = {name: round(statistics.mean(each), 1) for name, each in found.items()}
    more = {name: round(value - means["nothing"], 1) for name, value in means.items() if name != "nothing"}
    print(json.dumps({"cpu %": means, "more": more, "runs": found}, indent=2))


if __name__ == "__main__":
    main()
