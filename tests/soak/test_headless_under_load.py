"""A stepped run is independent of wall time: two hundred runs beside sixteen busy processes give one report."""

import json
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))
from headless_under_load import outcomes

pytestmark = pytest.mark.soak
RUNS = 200


def test_all_runs_give_the_same_report():
    ended = outcomes(RUNS, busy=16)
    assert list(ended.values()) == [RUNS], ended
    assert json.loads(next(iter(ended)))["deterministic"] is True
