"""Launch files recorded on real ROS 2 Jazzy, replayed: resolution, parameter types, events, exit codes, texts."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

RECORDS = Path(os.environ.get("BOT_CONSOLE_ORACLE", ""))
COMMAND = (
    f"{sys.executable} -c 'import sys; from bot_console.runtime.importer import install; install(); "
    'from ros2cli.command_line import main; sys.exit(main(["launch", *sys.argv[1:]]))\''
)
OFTEN = (
    "course_step5_given", "course_robot_system_long_missing_file", "course_environment_outdoor",
    "course_args_step5_with_arguments", "course_run_step4", "course_run_step5_integer_speed", "course_run_robot_system",
)  # fmt: skip
"""Of each kind that is compared: what is resolved, the command line, a whole run; each replay starts `ros2 launch`."""
LONG = (
    "arguments", "command_line", "conditions", "course", "events", "front_ends", "parameters", "ros_names",
    "substitutions",
)  # fmt: skip


pytestmark = pytest.mark.skipif(not os.environ.get("BOT_CONSOLE_ORACLE"), reason="BOT_CONSOLE_ORACLE names no records")


@pytest.mark.soak
@pytest.mark.timeout(600)
@pytest.mark.parametrize("area", LONG)
def test_area(area: str, tmp_path: Path) -> None:
    assert replayed(tmp_path, "--area", area) > 0


@pytest.mark.skipif(not os.environ.get("BOT_CONSOLE_COURSE"), reason="BOT_CONSOLE_COURSE names no course")
def test_some_of_the_course(tmp_path: Path) -> None:
    assert replayed(tmp_path, *(word for each in OFTEN for word in ("--only", each))) == len(OFTEN)


def replayed(tmp_path: Path, *which: str) -> int:
    """How many records were replayed, all of them as they were recorded."""
    report = tmp_path / "report.json"
    course = os.environ.get("BOT_CONSOLE_COURSE", "")
    words = ["--command", COMMAND, *which, "--jobs", "2", "--json", str(report), "--timeout", "90"]
    words += ["--course", course] if course else []
    subprocess.run([sys.executable, str(RECORDS / "launch_replay.py"), *words], check=False, capture_output=True)
    outcome = json.loads(report.read_text("utf-8"))
    assert outcome["failed"] == {}
    passed: int = outcome["passed"]
    return passed
