"""Launch files recorded on real ROS 2 Jazzy, replayed: resolution, parameter types, events, exit codes, texts."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from helpers.recorded.cases import GIVEN, NOT_GIVEN, RECORDINGS, differing_on_purpose, faults

COURSE = os.environ.get("BOT_CONSOLE_COURSE", "")
COMMAND = (
    f"{sys.executable} -c 'import sys; from bot_console.runtime.importer import install; install(); "
    'from ros2cli.command_line import main; sys.exit(main(["launch", *sys.argv[1:]]))\''
)
OFTEN = (
    "course_step5_given", "course_robot_system_long_missing_file", "course_environment_outdoor",
    "course_args_step5_with_arguments", "course_run_step4", "course_run_step5_integer_speed", "course_run_robot_system",
)  # fmt: skip
"""One area for each kind of comparison: resolution, command line, a whole run; each replay starts `ros2 launch`."""
AREAS = (
    "arguments", "command_line", "conditions", "course", "events", "front_ends", "parameters", "ros_names",
    "substitutions",
)  # fmt: skip
"""All areas; `test_every_area_is_replayed` compares them with the recordings."""

pytestmark = pytest.mark.skipif(not GIVEN, reason=NOT_GIVEN)


@pytest.mark.recorded
@pytest.mark.timeout(600)
@pytest.mark.parametrize("area", AREAS)
def test_area_equals_recording(area: str, tmp_path: Path) -> None:
    expected = {row["id"] for row in recorded_cases() if row["area"] == area}
    assert replayed(tmp_path, "--area", area) == expected


@pytest.mark.recorded
def test_every_area_is_replayed() -> None:
    assert {row["area"] for row in recorded_cases()} == set(AREAS)
    assert set(differing_on_purpose("launch")) <= {row["id"] for row in recorded_cases()}


@pytest.mark.soak
@pytest.mark.skipif(not COURSE, reason="BOT_CONSOLE_COURSE names no course")
def test_some_course_cases_equal_recording(tmp_path: Path) -> None:
    assert replayed(tmp_path, *(word for each in OFTEN for word in ("--only", each))) == set(OFTEN)


def recorded_cases() -> list[dict[str, Any]]:
    """The recorded cases."""
    rows: list[dict[str, Any]] = json.loads((RECORDINGS / "launch" / "cases.json").read_text("utf-8"))
    return rows


def replayed(tmp_path: Path, *which: str) -> set[str]:
    """Replay cases; return the ids of those that equal the recording, or that need the course where it is missing."""
    report = tmp_path / "report.json"
    words = ["--command", COMMAND, *which, "--jobs", "2", "--json", str(report), "--timeout", "90"]
    words += ["--course", COURSE] if COURSE else []
    subprocess.run([sys.executable, str(RECORDINGS / "launch_replay.py"), *words], check=False, capture_output=True)
    outcome = json.loads(report.read_text("utf-8"))
    assert faults("launch", outcome["seconds"], outcome["failed"]) == {}
    return {*outcome["seconds"], *outcome["skipped"]}
