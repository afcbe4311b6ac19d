"""Whether a long run stays flat: memory, threads and descriptors of all its processes, sampled; JSON.

    python tests/soak/steady.py --simulated 24    hours of the default robot without a screen, as fast as possible
    python tests/soak/steady.py --live 30         minutes of a console with its robot in a terminal of 120x40
    python tests/soak/steady.py --live 30 --filled 20    the same, sampled after 20 minutes

A line is fitted to the samples of each quantity, without the first fifth, in which programs start and fill caches.
`slope` is in MB, threads or descriptors per simulated hour or live minute, `slope_last_half` that of the second half
alone; `first` and `last` are the means of a tenth of the samples at either end. Linux.

Bounded buffers fill meanwhile, at the rates of the default robot: the last two minutes for a bag (2 min); a plotted
curve, 20,000 samples (17 min at 20 Hz), 1 MB with what the pane holds of it; 12,000 poses, 0.4 MB (20 min); the last
1,000 lines of a node for late subscribers (the navigator's in 17 min, the safety monitor's in 2 h); the lengths of
4,096 texts that were drawn (about 20 min); about 75 bytes for each line of the log, up to a million lines.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "acceptance" / "console"))
from terminal import Terminal

PAGE = os.sysconf("SC_PAGE_SIZE")
NAMES = ("memory_mb", "threads", "descriptors")
Sample = tuple[float, int, int]


def descendants(pid: int) -> list[int]:
    """The ids of a process and all its descendants."""
    found = [pid]
    for each in found:
        with contextlib.suppress(OSError):
            for task in Path(f"/proc/{each}/task").iterdir():
                found += map(int, (task / "children").read_text().split())
    return found


def sample(pid: int) -> Sample:
    """Unshared memory (MB), threads and open descriptors of a process and its descendants."""
    memory, threads, descriptors = 0.0, 0, 0
    for each in descendants(pid):
        with contextlib.suppress(OSError):
            _, resident, shared, *_ = Path(f"/proc/{each}/statm").read_text().split()
            memory += (int(resident) - int(shared)) * PAGE / 1e6
            threads += len(os.listdir(f"/proc/{each}/task"))
            descriptors += len(os.listdir(f"/proc/{each}/fd"))
    return memory, threads, descriptors


def fit_line(samples: list[Sample], length: float) -> dict[str, Any]:
    """The line fitted to the samples of a run of some length (hours, minutes), for each quantity."""
    rows = np.array(samples, dtype=float)
    start, tenth = len(rows) // 5, max(1, len(rows) // 10)
    moments = np.linspace(0.0, length, len(rows))
    return {
        name: {
            "slope": _slope(moments[start:], rows[start:, column]),
            "slope_last_half": _slope(moments[len(rows) // 2 :], rows[len(rows) // 2 :, column]),
            "first": round(float(rows[start : start + tenth, column].mean()), 2),
            "last": round(float(rows[-tenth:, column].mean()), 2),
            "most": round(float(rows[:, column].max()), 2),
        }
        for column, name in enumerate(NAMES)
    }


def _slope(moments: Any, figures: Any) -> float:
    return round(float(np.polyfit(moments, figures, 1)[0]), 5)


def simulated(hours: float, folder: Path) -> dict[str, Any]:
    """Run the default robot headless and stepped for `hours` of simulated time."""
    words = ["-m", "bot_console.tui", "--headless", "--fast", "--seed", "1", "--duration", str(hours * 3600)]
    with (folder / "log").open("wb") as log, (folder / "report.json").open("wb") as report:
        process = subprocess.Popen([sys.executable, *words], cwd=folder, stdout=report, stderr=log)
        samples = _until(lambda: process.poll() is not None, process.pid)
    (folder / "log").unlink()
    return {"hours": hours, "exit_code": process.returncode, "samples": len(samples), **fit_line(samples, hours)}


def live(minutes: float, filled: float, folder: Path) -> dict[str, Any]:
    """Run a console with its robot; its output is read as by a terminal, and keys switch between its panes.

    It is sampled for `minutes`, after `filled` minutes in which it fills its buffers.
    """
    terminal, samples = Terminal(["-m", "bot_console.tui", "--seed", "1"], folder), []
    try:
        terminal.read_until(lambda: b"robot_navigator" in terminal.output, "the robot")
        pane = 0

        def over(end: float) -> bool:
            nonlocal pane
            terminal.drain(0.5)
            terminal.output = terminal.output[-10_000:]
            pane = pane % 8 + 1
            terminal.type(str(pane))
            return time.monotonic() > end or terminal.process.poll() is not None

        for span in (filled, minutes):
            samples = _until(partial(over, time.monotonic() + span * 60), terminal.process.pid)
        terminal.type("q")
        code = terminal.wait()
    finally:
        terminal.close()
    return {
        "minutes": minutes,
        "filled": filled,
        "exit_code": code,
        "samples": len(samples),
        **fit_line(samples, minutes),
    }


def _until(over: Callable[[], bool], pid: int) -> list[Sample]:
    """Sample a process and its descendants about twice a second until `over` returns true."""
    samples: list[Sample] = []
    while not over():
        samples.append(sample(pid))
        if len(samples) % 120 == 0:
            print(f"{len(samples)} samples, now {samples[-1]}", file=sys.stderr, flush=True)
        time.sleep(0.5)
    return samples


def main() -> None:
    """Run with the command line's options."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--simulated", type=float, metavar="HOURS")
    parser.add_argument("--live", type=float, metavar="MINUTES")
    parser.add_argument("--filled", type=float, metavar="MINUTES", default=0.0)
    options = parser.parse_args()
    folder, sockets = Path(tempfile.mkdtemp(prefix="steady")), Path(tempfile.mkdtemp(prefix="bcs"))
    os.environ |= {
        "BOT_CONSOLE_SOCKET_DIR": str(sockets),
        "XDG_STATE_HOME": str(folder),
        "XDG_CONFIG_HOME": str(folder),
    }
    report: dict[str, Any] = {}
    try:
        if options.simulated:
            report["simulated"] = simulated(options.simulated, folder)
        if options.live:
            report["live"] = live(options.live, options.filled, folder)
    finally:
        shutil.rmtree(folder, ignore_errors=True)
        shutil.rmtree(sockets, ignore_errors=True)
    print(json.dumps(report, indent=2))
    sys.exit(any(each["exit_code"] for each in report.values()))


if __name__ == "__main__":
    main()
