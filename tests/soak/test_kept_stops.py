"""A stop holds until a person releases it, whatever ends and starts meanwhile; a witness judges by the ground truth.

In one process: `tests/unit/tui/console/test_kept_stops.py`. Many runs beside busy processes: `witnessed_runs.py`.
"""

from __future__ import annotations

import os
import shutil
import tempfile
from pathlib import Path

import pytest

if os.name == "nt":
    pytest.skip("needs Unix sockets", allow_module_level=True)

from processes.kept_stops import StopScenario, held_through
from processes.live_robot import BackgroundRobot, LiveRobot, live_robot
from processes.ways_to_lose_stops import SCENARIOS

pytestmark = pytest.mark.soak


@pytest.mark.parametrize("scenario", SCENARIOS, ids=lambda each: each.name)
def test_a_stop_holds_until_it_is_released_and_then_does_not_come_back(tmp_path: Path, scenario: StopScenario) -> None:
    sockets = Path(tempfile.mkdtemp(prefix="bcs"))
    try:
        with live_robot(
            tmp_path, sockets, domain=78, kind=BackgroundRobot if scenario.in_background else LiveRobot
        ) as robot:
            held_through(scenario, robot)
    finally:
        shutil.rmtree(sockets, ignore_errors=True)
