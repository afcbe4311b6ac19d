"""Live runs beside busy processes in which a robot is stopped, or loses its operator or its safety monitor.

    python tests/soak/witnessed_runs.py --runs 50 --busy 2 [--only person]

Judged by a witness of the ground truth in a separate process. Prints one JSON object: for each of the groups `stop`,
`person`, `monitor` and `kept` (stops that outlive locks and consoles) how many runs there were, how many of them moved
when they had to stand, and how long (s) the robot went on.
"""

from __future__ import annotations

import argparse
import json
import shutil
import signal
import statistics
import sys
import tempfile
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[1] / "helpers"))
sys.path.insert(0, str(Path(__file__).parent))
from headless_under_load import busy_processes
from processes.kept_stops import KEPT
from processes.live_robot import LiveRobot, live_robot
from processes.losses import GROUPS as LOSSES

GROUPS = {**LOSSES, "kept": KEPT}


def witnessed(group: str, runs: int, robot: LiveRobot) -> dict[str, Any]:
    """Go through the losses of a group in turn; a failed run is printed and counted, and the robot is released."""
    went_on: dict[str, list[float]] = {each.__name__: [] for each in GROUPS[group]}
    failed: list[str] = []
    for number in range(runs):
        loss = GROUPS[group][number % len(GROUPS[group])]
        try:
            went_on[loss.__name__].append(round(loss(robot), 3))
        except AssertionError as error:
            failed.append(f"run {number}, {loss.__name__}: {str(error)[:300]}")
            robot.typed("release", "--all")
        print(f"{group}: {number + 1} of {runs}, {len(failed)} failed", file=sys.stderr, flush=True)
    summary = {
        name: {"runs": len(each), "median": statistics.median(each), "longest": max(each)}
        for name, each in went_on.items()
        if each
    }
    return {"runs": runs, "failed": failed, "went on (s)": summary}


def main() -> None:
    """Run with the command line's options."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--runs", type=int, default=50, help="in each group")
    parser.add_argument("--busy", type=int, default=2)
    parser.add_argument("--only", choices=list(GROUPS))
    options = parser.parse_args()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))  # So that the robot's processes end as well.
    report: dict[str, Any] = {}
    folder, sockets = Path(tempfile.mkdtemp()), Path(tempfile.mkdtemp(prefix="bcs"))
    try:
        with busy_processes(options.busy):
            for group in [options.only] if options.only else GROUPS:
                with live_robot(folder, sockets) as robot:
                    report[group] = witnessed(group, options.runs, robot)
    finally:
        for each in (folder, sockets):
            shutil.rmtree(each, ignore_errors=True)
    print(json.dumps({"busy": options.busy, **report}, indent=2))
    sys.exit(any(each["failed"] for each in report.values()))


if __name__ == "__main__":
    main()
