"""Runs the programs in `tests/contract/live/programs` on a real rclpy and on ours, and prints the differences.

    python tools/compare_programs.py REAL_PYTHON [--record] [NAME ...]

Accepted differences are listed in `tests/contract/live/programs.yaml`. `REAL_PYTHON` is the interpreter of an
environment with `ros-jazzy-rclpy`; `--record` saves its outcomes.
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests"))

from helpers.recorded.programs import RECORDED, differing, names, outcome

OURS = [str(Path(sys.executable).with_name("bot-console")), "run"]
DOMAIN = 66


def main() -> int:
    """Compare all programs; returns 1 if one differs without a listed reason, or no longer differs."""
    parser = argparse.ArgumentParser()
    parser.add_argument("real_python")
    parser.add_argument("--record", action="store_true")
    parser.add_argument("names", nargs="*")
    arguments = parser.parse_args()
    recorded = json.loads(RECORDED.read_text("utf-8")) if RECORDED.exists() else {}
    faults = 0
    for name in arguments.names or names():
        real, ours = (outcome(command, name, DOMAIN) for command in ([arguments.real_python], OURS))
        recorded[name] = real
        if (real != ours) is (name in differing()):
            continue
        faults += 1
        print(f"{name}:", "no longer differs" if real == ours else f"\n  real {real}\n  ours {ours}")
    if arguments.record:
        RECORDED.write_text(json.dumps(recorded, indent=1, sort_keys=True) + "\n", "utf-8")
    print(f"{faults} of {len(arguments.names or names())} programs need a decision")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
