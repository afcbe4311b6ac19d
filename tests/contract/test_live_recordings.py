"""The recorded programs on the live rclpy from PyPI: it differs from the recordings only where `live/` says so.

`BOT_CONSOLE_TESTS_DISTRO` names the distribution. With `BOT_CONSOLE_TESTS_RECORD=FOLDER`, the differences are also
written there, one file per area.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from domains import unused_domain
from helpers.recorded.cases import GIVEN, NOT_GIVEN, RECORDINGS, recorded_areas
from helpers.recorded.releases import LIVE, PYPI_TYPES, absent_types, as_recorded
from rigs import is_embedded_rclpy

pytestmark = [
    pytest.mark.ros,
    pytest.mark.timeout(600),
    pytest.mark.skipif(is_embedded_rclpy(), reason="needs the rclpy of PyPI: .ci/on_rclpy"),
    pytest.mark.skipif(not GIVEN, reason=NOT_GIVEN),
]
DISTRO = os.environ.get("BOT_CONSOLE_TESTS_DISTRO", "jazzy")
TIMED = ("programs/main_with_spin_and_interrupt",)
"""Interrupts itself after 0.3 s, when a busy machine may not have begun to spin: checked only with our rclpy."""
SETUP = f"exec(open({str(PYPI_TYPES)!r}).read())"


def differing_cases(folder: Path, *which: str) -> dict[str, Any]:
    """Outcomes that differ from the recording, by id of the case."""
    report = folder / "report.json"
    words = [*which, "--setup", SETUP, "--report", str(report)]
    subprocess.run([sys.executable, str(RECORDINGS / "replay.py"), *words], check=False, capture_output=True)
    outcome = json.loads(report.read_text("utf-8"))
    assert outcome["passed"] + outcome["failed"] > 0 and outcome["unrecorded"] == []
    pairs = outcome["cases"].items()
    found = {case: pair["got"] for case, pair in pairs if not as_recorded(pair["got"], pair["expected"])}
    return {case: {key: value for key, value in got.items() if key != "trace"} for case, got in found.items()}


@pytest.mark.parametrize("area", recorded_areas())
def test_area_is_replayed_as_recorded(
    area: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest
) -> None:
    monkeypatch.setenv("ROS_DOMAIN_ID", str(unused_domain()))
    known = json.loads((LIVE / f"{DISTRO}.json").read_text("utf-8"))
    found = differing_cases(tmp_path, area)
    doubtful = [case for case in found if case not in known and not absent_types(found[case])]
    if doubtful:  # a busy machine may have been too slow the first time
        found = {case: got for case, got in found.items() if case not in doubtful}
        found |= differing_cases(tmp_path, *doubtful)
    absent = [case for case, got in found.items() if absent_types(got)]
    if absent:
        print(f"{area}: {len(absent)} cases need types that PyPI does not have, and did not run")
    found = {case: got for case, got in found.items() if case not in (*absent, *TIMED)}
    if folder := os.environ.get("BOT_CONSOLE_TESTS_RECORD"):
        (Path(folder) / f"{DISTRO}-{area}.json").write_text(json.dumps(found), "utf-8")
        return
    mine = {case: got for case, got in known.items() if case.startswith(f"{area}/")}
    assert found == mine
