"""Small programs recorded on real rclpy, replayed: values, exceptions with their texts, log lines, warnings."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest
from helpers.recorded.cases import GIVEN, NOT_GIVEN, RECORDINGS, differing_on_purpose, faults

pytestmark = [pytest.mark.recorded, pytest.mark.timeout(600), pytest.mark.skipif(not GIVEN, reason=NOT_GIVEN)]

SETUP = "from bot_console.runtime.importer import install; install()"


def recorded() -> dict[str, list[str]]:
    """The ids of all recorded cases, by area."""
    if not GIVEN:
        return {}
    areas: dict[str, list[str]] = {}
    for case in json.loads((RECORDINGS / "rclpy" / "expected.json").read_text("utf-8"))["cases"]:
        areas.setdefault(case.partition("/")[0], []).append(case)
    return areas


@pytest.mark.parametrize("area", recorded())
def test_area(area: str, tmp_path: Path) -> None:
    report = tmp_path / "report.json"
    words = [area, "--setup", SETUP, "--report", str(report)]
    subprocess.run([sys.executable, str(RECORDINGS / "replay.py"), *words], check=False, capture_output=True)
    outcome = json.loads(report.read_text("utf-8"))
    replayed = recorded()[area]
    assert faults("rclpy", replayed, outcome["cases"]) == {}
    assert outcome["passed"] + outcome["failed"] == len(replayed) and outcome["unrecorded"] == []


def test_every_case_listed_as_different_is_recorded() -> None:
    assert set(differing_on_purpose("rclpy")) <= {case for area in recorded().values() for case in area}
