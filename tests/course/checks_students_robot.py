"""The student's own package, with a robot that moves: the page's files as printed, beside our simulator."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

from course.page import Page, make_workspace
from course.rows import Row
from course.table import row
from processes.command_line import run_cli

PROFILES = {"indoor": (1.0, 0.5), "outdoor": (2.0, 1.0), "warehouse": (1.4, 0.7), "competition": (3.0, 0.4)}
"""Speed (m/s) and safety distance (m) that a student may choose: the page asks for higher, medium and lowest."""


_reports: dict[str, dict[str, Any]] = {}
"""The report of each drive so far, by the text of its configuration."""


def drive(folder: Path, config: Path) -> dict[str, Any]:
    """The report of a minute with the student's launch file and one configuration, run once for all rows."""
    text = config.read_text("utf-8")
    if text not in _reports:
        _reports[text] = drive_for_a_minute(folder, config)
    return _reports[text]


def drive_for_a_minute(folder: Path, config: Path) -> dict[str, Any]:
    """Drive for a minute."""
    launch = "src/intelligent_robot/launch/robot_system.launch.py"
    words = ["--headless", "--fast", "--duration", "60", "--launch", launch, f"config_file:={config}"]
    done = run_cli(*words, cwd=folder, env={**os.environ, "ROS_HOME": str(folder)})
    assert done.returncode == 0, done.stderr[-3000:]
    assert "the simulated robot runs beside it" in done.stderr
    assert all(f"[{each}-" in done.stderr for each in ("robot_node", "sensor_node", "safety_node", "telemetry_node"))
    return json.loads(done.stdout)


@row(391)
def check_nodes_of_the_student_drive(page: Page, row: Row) -> None:
    folder = make_workspace(page.scratch / "ws", complete=True)
    assert drive(folder, folder / "src" / "intelligent_robot" / "config" / "indoor_config.yaml")["distance"] > 10.0


@row(392, slow=True)
def check_each_configuration_drives_differently(page: Page, row: Row) -> None:
    folder = make_workspace(page.scratch / "ws", complete=True)
    config = folder / "src" / "intelligent_robot" / "config"
    printed = (config / "indoor_config.yaml").read_text("utf-8")
    speeds = []
    for name, (speed, distance) in PROFILES.items():
        text = printed.replace("max_speed: 1.0", f"max_speed: {speed}")
        path = config / f"{name}_config.yaml"
        path.write_text(text.replace("safety_distance: 0.5", f"safety_distance: {distance}"), "utf-8")
        speeds.append(drive(folder, path)["mean_speed"])
    assert all(abs(one - other) > 0.05 for at, one in enumerate(speeds) for other in speeds[:at]), speeds


@row(337)
def check_package_has_a_readme(page: Page, row: Row) -> None:
    assert page.bot_console("export", str(page.scratch)).exit == 0
    text = (page.scratch / "bot_console_robot" / "README.md").read_text("utf-8")
    assert "ros2 launch bot_console_robot robot_system.launch.py" in text
    assert "| `robot_navigator.max_speed` |" in text
    assert "environment_launch.py" in text
