"""The cost of tuning: `python tests/benchmarks/bench_tune.py [--program BOT_CONSOLE ...]`, JSON lines.

`cpu_s` is the CPU time of one `bot-console tune` with all its processes, `loops` the same in units of a plain Python
loop that is timed before and after it (`plain_loop.py`), which can be compared between machines and moments. `score` is
the best setting's, which shows that two programs did the same work. With several `--program`, such as
`OTHER_CHECKOUT/.venv/bin/bot-console`, they alternate.
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
from typing import Any

from plain_loop import loop_s

TUNED = ("max_speed", "safety_distance", "turn_rate")


def children_s() -> float:
    """CPU time (s) of the child processes that have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def tune(program: list[str], runs: int, duration_s: float) -> dict[str, Any]:
    """Tune once, in a separate folder, domain and state folder."""
    words = ["tune", *TUNED, "--runs", str(runs), "--duration", str(duration_s), "--json"]
    with tempfile.TemporaryDirectory(prefix="bt", dir="/tmp") as folder:
        places = {"XDG_STATE_HOME": "state", "XDG_CONFIG_HOME": "config", "BOT_CONSOLE_USER_DIR": "user"}
        env = {**os.environ, **{name: os.path.join(folder, place) for name, place in places.items()}}
        loop, used = loop_s(), children_s()
        done = subprocess.run([*program, *words], cwd=folder, env=env, check=True, stdout=subprocess.PIPE, text=True)
        used, loop = children_s() - used, (loop + loop_s()) / 2
    result = json.loads(done.stdout)
    return {
        "cpu_s": round(used, 2),
        "cpu_s_per_run": round(used / runs, 3),
        "loop_s": round(loop, 3),
        "loops": round(used / loop, 1),
        "score": result["best"]["score"],
    }


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description="The processor time of tuning.")
    parser.add_argument("--program", action="append", help="another bot-console, to be compared; may be repeated")
    parser.add_argument("--runs", type=int, default=60)
    parser.add_argument("--duration", type=float, default=60.0, help="simulated seconds of a run")
    parser.add_argument("--repeats", type=int, default=2)
    given = parser.parse_args()
    programs = [[os.path.abspath(each)] for each in given.program or ()] or [[sys.executable, "-m", "bot_console.tui"]]
    for _ in range(given.repeats):
        for program in programs:
            print(json.dumps({"program": program[0], **tune(program, given.runs, given.duration)}), flush=True)


if __name__ == "__main__":
    main()
