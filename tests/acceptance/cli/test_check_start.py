"""`check SCRIPT --start` runs its steps on separately started nodes, in simulated time."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

import pytest
from bot_console.tui.cli.check.stepped import StartError, read_start
from processes.command_line import run_cli

NAVIGATOR = "run bot_console_robot robot_node"
SIMULATOR = "launch bot_console_robot simulator.launch.py seed:=3"


def run_check(folder: Path, steps: str, *starts: str) -> tuple[int, list[dict[str, Any]]]:
    (folder / "steps").write_text(steps, "utf-8")
    options = [word for each in starts for word in ("--start", each)]
    done = run_cli("check", "steps", "--json", *options, cwd=folder, env={**os.environ, "ROS_HOME": str(folder)})
    return done.returncode, json.loads(done.stdout)["steps"]


def test_steps_run_on_the_started_programs_with_the_same_result_each_time(tmp_path: Path) -> None:
    steps = (
        "expect-refused /robot_navigator max_speed 10.0\n"
        "set /robot_navigator max_speed 2.0\n"
        "expect /odom/twist.twist.linear.x > 0.5 within 60 s\n"
        "expect-node /never within 2 s\n"
    )
    first = run_check(tmp_path, steps, SIMULATOR, NAVIGATOR)
    code, found = first
    assert code == 1
    assert [each["why"] for each in found] == ["", "", "", "there is none; nodes: /robot_navigator, /simulator"]
    assert found[3]["seconds"] == pytest.approx(2.0, abs=0.5)
    assert run_check(tmp_path, steps, SIMULATOR, NAVIGATOR) == first


def test_step_after_the_end_of_all_nodes_is_reported_as_not_reached(tmp_path: Path) -> None:
    _, found = run_check(tmp_path, "expect-node /robot_navigator\n", f"{NAVIGATOR} --ros-args -p max_speed:=1")
    assert [each["why"] for each in found] == ["not reached: robot_node-1 ended with exit code 1"]


@pytest.mark.parametrize(
    ("line", "why"),
    [
        ("run bot_console_robot", "write `run PACKAGE EXECUTABLE"),
        ("go bot_console_robot robot_node", "write `run PACKAGE EXECUTABLE"),
        ("run 'bot_console_robot robot_node", "No closing quotation"),
        ("launch bot_console_robot simulator.launch.py seed=3", "write `run PACKAGE EXECUTABLE"),
        ("launch bot_console_robot nowhere.launch.py", "nowhere.launch.py"),
    ],
)
def test_invalid_start_line_is_refused_with_the_accepted_form(line: str, why: str) -> None:
    with pytest.raises(StartError, match=why):
        read_start(line)
