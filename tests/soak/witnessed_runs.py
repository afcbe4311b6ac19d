"""Live runs beside busy processes in which a robot is stopped, or loses its operator or its safety monitor.

    python tests/soak/witnessed_runs.py --runs 50 --busy 2 [--only kept] [--way "link cut"]

A witness in a separate process judges by the ground truth. Prints one JSON object: for each of the groups `stop`,
`person`, `monitor`, `kept` and `kept in background` (ways to lose a stop, for two kinds of robots) the number of runs,
how many of them failed, and how long (s) the robot moved on.
"""

from __future__ import annotations

import argparse
import json
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import traceback
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[1] / "helpers"))
sys.path.insert(0, str(Path(__file__).parent))
from headless_under_load import busy_processes
from processes.kept_stops import held_through
from processes.live_robot import BackgroundRobot, LiveRobot, live_robot
from processes.losses import GROUPS as LOSSES
from processes.ways_to_lose_stops import SCENARIOS

Run = Callable[[LiveRobot], float]
"""Returns how long (s) the robot moved on; raises `AssertionError` if it moved later."""
KEPT = "kept"
IN_BACKGROUND = "kept in background"
GROUPS: dict[str, dict[str, Run]] = {
    **{group: {each.__name__: each for each in runs} for group, runs in LOSSES.items()},
    KEPT: {each.name: partial(held_through, each) for each in SCENARIOS if not each.in_background},
    IN_BACKGROUND: {each.name: partial(held_through, each) for each in SCENARIOS if each.in_background},
}


def run_group(group: str, ways: Sequence[str], runs: int, robot: LiveRobot) -> dict[str, Any]:
    """Run the ways of a group in turn; count failures, and release the robot after each."""
    went_on: dict[str, list[float]] = {each: [] for each in ways}
    failed: list[str] = []
    for number in range(runs):
        way = ways[number % len(ways)]
        try:
            went_on[way].append(round(GROUPS[group][way](robot), 3))
        except (AssertionError, subprocess.TimeoutExpired) as error:
            failed.append(f"run {number}, {way}: {str(error)[-1500:]}")
            traceback.print_exc()
            robot.run_cli("release", "--all")
        print(f"{group}: {number + 1} of {runs}, {len(failed)} failed", file=sys.stderr, flush=True)
    summary = {
        name: {"runs": len(each), "median": statistics.median(each), "longest": max(each)}
        for name, each in went_on.items()
        if each
    }
    return {"runs": runs, "failed": failed, "went on (s)": summary}


def main() -> None:
    """Run according to the command line."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--runs", type=int, default=50, help="in each group")
    parser.add_argument("--busy", type=int, default=2)
    parser.add_argument("--only", choices=list(GROUPS), help="this group alone")
    parser.add_argument("--way", action="append", default=[], help="only runs with this name; repeatable")
    options = parser.parse_args()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))  # So that the robot's processes end as well.
    report: dict[str, Any] = {}
    folder, sockets = Path(tempfile.mkdtemp()), Path(tempfile.mkdtemp(prefix="bcs"))
    try:
        with busy_processes(options.busy):
            for group in [options.only] if options.only else GROUPS:
                ways = [each for each in GROUPS[group] if not options.way or each in options.way]
                if not ways:
                    continue
                kind = BackgroundRobot if group == IN_BACKGROUND else LiveRobot
                with live_robot(folder, sockets, kind=kind) as robot:
                    report[group] = run_group(group, ways, options.runs, robot)
    finally:
        for each in (folder, sockets):
            shutil.rmtree(each, ignore_errors=True)
    print(json.dumps({"busy": options.busy, **report}, indent=2))
    sys.exit(any(each["failed"] for each in report.values()))


if __name__ == "__main__":
    main()
