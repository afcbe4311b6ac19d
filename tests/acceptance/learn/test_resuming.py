"""A course is resumed in a workspace that has launch files."""

from __future__ import annotations

from pathlib import Path

from processes.command_line import run_cli

LAUNCH = """\
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([Node(package="bot_console_robt", executable="simulator_node")])
"""


def test_course_is_listed_in_workspace_with_launch_files(tmp_path: Path) -> None:
    (tmp_path / "launch").mkdir()
    (tmp_path / "launch" / "one.launch.py").write_text(LAUNCH, encoding="utf-8")
    done = run_cli("learn", "--list", cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    assert "0 of 60 done" in done.stdout
