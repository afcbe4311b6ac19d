"""Stepped runs beside busy processes: each must report, and all must report the same.

    python tests/soak/headless_under_load.py --runs 200 --busy 16

Prints one JSON object: how many runs there were, and how many ended how. `--nice` applies to the runs and to the busy
processes, so that a shared machine stays usable.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
from collections import Counter
from collections.abc import Generator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from typing import Any

BUSY = "while True: pass"
TIMEOUT_S = 600.0
"""Seconds after which a run is given up; nothing is measured by it."""


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


def run(seconds: float) -> str:
    """The outcome of one run: the digest of its report, marked if it is not deterministic, or its last output."""
    words = ["--headless", "--fast", "--seed", "1", "--duration", str(seconds)]
    line = [sys.executable, "-m", "bot_console.tui", *words]
    done = subprocess.run(line, capture_output=True, text=True, check=False, timeout=TIMEOUT_S)
    if done.returncode:
        return f"exit code {done.returncode}: {done.stderr[-200:]}"
    report: dict[str, Any] = json.loads(done.stdout)
    del report["wall_time"]
    return json.dumps(report, sort_keys=True)


def outcomes(runs: int, busy: int, seconds: float = 10.0) -> Counter[str]:
    """The outcomes of the runs with their counts, printed on stderr as runs end; one run per processor at a time."""
    ended: Counter[str] = Counter()
    with busy_processes(busy), ThreadPoolExecutor(os.cpu_count()) as pool:
        for outcome in pool.map(run, [seconds] * runs):
            ended[outcome] += 1
            print(f"{ended.total()} of {runs} runs, {len(ended)} outcomes", file=sys.stderr, flush=True)
    return ended


def main() -> None:
    """Run with the command line's options."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--runs", type=int, default=200)
    parser.add_argument("--busy", type=int, default=16)
    parser.add_argument("--seconds", type=float, default=10.0)
    parser.add_argument("--nice", type=int, default=0)
    options = parser.parse_args()
    os.nice(options.nice)
    ended = outcomes(options.runs, options.busy, options.seconds)
    print(json.dumps({"runs": options.runs, "outcomes": len(ended), "ended": ended}, indent=2))


if __name__ == "__main__":
    main()
