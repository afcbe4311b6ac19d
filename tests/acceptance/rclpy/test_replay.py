"""Small programs recorded on real rclpy, replayed: values, exceptions with their texts, log lines, warnings."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest
from helpers.recorded.cases import GIVEN, NOT_GIVEN, RECORDINGS, differing_on_purpose, faults, recorded_areas

pytestmark = [pytest.mark.recorded, pytest.mark.timeout(600), pytest.mark.skipif(not GIVEN, reason=NOT_GIVEN)]

SETUP = "from bot_console.runtime.importer import install; install()"


@pytest.mark.parametrize("area", recorded_areas())
def test_area_equals_recording(area: str, tmp_path: Path) -> None:
    report = tmp_path / "report.json"
    words = [area, "--setup", SETUP, "--report", str(report)]
    subprocess.run([sys.executable, str(RECORDINGS / "replay.py"), *words], check=False, capture_output=True)
    outcome = json.loads(report.read_text("utf-8"))
    replayed = recorded_areas()[area]
    assert faults("rclpy", replayed, outcome["cases"]) == {}
    assert outcome["passed"] + outcome["failed"] == len(replayed) and outcome["unrecorded"] == []


def test_every_case_listed_as_different_is_recorded() -> None:
    assert set(differing_on_purpose("rclpy")) <= {case for area in recorded_areas().values() for case in area}
