"""The course page's own navigator, unchanged, drives our robot."""

import os
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))
from headless import TIMEOUT_S, headless

COURSE = os.environ.get("BOT_CONSOLE_COURSE", "")
NODE = Path(COURSE) / "nodes" / "intelligent_robot" / "robot_node.py"

pytestmark = [
    pytest.mark.skipif(not COURSE, reason="BOT_CONSOLE_COURSE names no folder"),
    pytest.mark.timeout(2 * TIMEOUT_S),
]


@pytest.mark.soak
@pytest.mark.parametrize("world", ["indoor", "outdoor", "warehouse", "competition"])
def test_page_navigator_drives_ten_minutes_in_our_system(tmp_path, world):
    report = headless(tmp_path, "--profile", world, "--duration", "600", f"navigator:={NODE}")
    assert report["longest_standstill"] < 20.0
    assert report["distance"] > 100.0


@pytest.mark.parametrize("minutes", [pytest.param(1, marks=pytest.mark.slow), pytest.param(10, marks=pytest.mark.soak)])
def test_page_navigator_drives_minutes_alone_with_the_simulator(tmp_path, minutes):
    report = headless(tmp_path, "--duration", str(60 * minutes), str(NODE), command=("run",))
    assert report["longest_standstill"] < 20.0
    assert report["distance"] > 10.0 * minutes
