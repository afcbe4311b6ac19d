"""How much faster than real time the complete system runs: `python tests/benchmarks/bench_headless.py`, JSON out.

Each run is a separate `bot-console --headless --fast`. `factor` is simulated seconds divided by CPU seconds of the
whole process, including its start; `steady_factor` excludes the start: it is computed from the difference between a
long run and a short one. Medians of several runs, with the lowest and the highest.
"""

from __future__ import annotations

import argparse
import json
import resource
import statistics
import subprocess
import sys
import tempfile

LONG, SHORT = 240.0, 20.0
PROFILES = ("indoor", "outdoor", "warehouse", "competition")


def cpu_of_run(profile: str, duration: float) -> float:
    """CPU seconds of a run."""
    words = ["-m", "bot_console.tui", "--headless", "--fast", "--profile", profile, "--duration", str(duration)]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, *words], cwd=folder, check=True, capture_output=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def median_and_range(values: list[float]) -> dict[str, float]:
    """Median, lowest and highest."""
    return {
        "median": round(statistics.median(values), 1),
        "low": round(min(values), 1),
        "high": round(max(values), 1),
    }


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description="Simulated seconds per CPU second of the complete system.")
    parser.add_argument("--repeats", type=int, default=5)
    repeats = parser.parse_args().repeats
    report: dict[str, object] = {"unit": "simulated s per CPU s", "goal": 150, "long_run_s": LONG, "repeats": repeats}
    for profile in PROFILES:
        whole: list[float] = []
        steady: list[float] = []
        for _ in range(repeats):
            long, short = cpu_of_run(profile, LONG), cpu_of_run(profile, SHORT)
            whole.append(LONG / long)
            steady.append((LONG - SHORT) / (long - short))
        report[profile] = {"factor": median_and_range(whole), "steady_factor": median_and_range(steady)}
    print(json.dumps(report, indent=2))


if __name__ == "__main__":
    main()
