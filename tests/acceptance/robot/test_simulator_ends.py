"""Simulated robots are started, reset and ended in every way, by concurrent threads: the physics does not crash."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

PROGRAM = Path(__file__).with_name("simulator_ends.py")
KINDS = 8


def run_simulator_ends(rounds: int, seed: int, timeout_s: float) -> None:
    """Run the program; an exit code of -11 means a segmentation fault."""
    line = [sys.executable, "-X", "faulthandler", str(PROGRAM), str(rounds), str(seed)]
    environment = {**os.environ, "PYTHONUNBUFFERED": "1"}
    done = subprocess.run(line, env=environment, capture_output=True, text=True, timeout=timeout_s, check=False)
    assert done.returncode == 0, done.stderr[-3000:]
    counts = json.loads(done.stdout)
    assert len(counts) == KINDS and sum(counts.values()) == rounds


@pytest.mark.soak
@pytest.mark.timeout(120)
def test_one_end_of_each_kind_does_not_crash() -> None:
    run_simulator_ends(KINDS, 1, 100.0)


@pytest.mark.soak
@pytest.mark.timeout(900)
def test_five_hundred_ends_do_not_crash() -> None:
    for seed in range(10):
        run_simulator_ends(50, seed, 400.0)
