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
OFTEN = ("course",)
"""It has launches of each kind that is compared: what is resolved, a whole run, and the command line."""
LONG = (
    "arguments", "command_line", "conditions", "events", "front_ends", "parameters", "ros_names", "substitutions"
)  # fmt: skip
AREAS = (*OFTEN, *(pytest.param(each, marks=[pytest.mark.soak, pytest.mark.timeout(600)]) for each in LONG))


@pytest.mark.skipif(not os.environ.get("BOT_CONSOLE_ORACLE"), reason="BOT_CONSOLE_ORACLE names no records")
@pytest.mark.parametrize("area", AREAS)
def test_area(area: str, tmp_path: Path) -> None:
    report = tmp_path / "report.json"
    course = os.environ.get("BOT_CONSOLE_COURSE", "")
    words = ["--command", COMMAND, "--area", area, "--jobs", "2", "--json", str(report), "--timeout", "90"]
    words += ["--course", course] if course else []
    subprocess.run([sys.executable, str(RECORDS / "launch_replay.py"), *words], check=False, capture_output=True)
    outcome = json.loads(report.read_text("utf-8"))
    assert outcome["failed"] == {}
    assert outcome["passed"] > 0
