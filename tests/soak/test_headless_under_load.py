"""A stepped run is independent of wall time: two hundred runs beside sixteen busy processes give the same report."""

import json
import os
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))
from headless_under_load import SYSTEMS, outcomes

pytestmark = pytest.mark.soak
RUNS = 200


@pytest.mark.timeout(0)
@pytest.mark.parametrize("system", SYSTEMS)
def test_all_runs_give_the_same_report(system):
    if system == "course" and not os.environ.get("BOT_CONSOLE_COURSE"):
        pytest.skip("BOT_CONSOLE_COURSE names no course")
    ended = outcomes(RUNS, busy=16, system=system)
    assert list(ended.values()) == [RUNS], ended
    assert json.loads(next(iter(ended)))["deterministic"] is True
