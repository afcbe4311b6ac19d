"""Everything marked `ros` on a foreign rclpy: a stand-in, used as on a machine with ROS 2."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from fakes.ros_installation import make_standin

if os.name == "nt":
    pytest.skip("needs Unix sockets", allow_module_level=True)

ROOT = Path(__file__).resolve().parents[3]
NEED_A_REAL_ONE = ("live_recordings", "own_ros2", "exported_package", "public_programs", "which_rclpy")
"""Suites about the location and behaviour of a ROS 2 on the machine: the stand-in is only a copy of our own rclpy."""
SOME = "refusal or commands or series_is_read"
ONLY_XDIST = {"PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1", "PYTEST_PLUGINS": "xdist.plugin"}
"""The only plug-in that the run needs: importing the others takes time."""


def on_the_stand_in(folder: Path, *words: str, **variables: str) -> None:
    environment = {**make_standin(folder), "BOT_CONSOLE_TESTS_ON": "ros", **ONLY_XDIST, **variables}
    line = [sys.executable, "-m", "pytest", "-q", "-rs", "-n", "0", "-m", "ros", *words]
    done = subprocess.run(line, cwd=ROOT, env=environment, capture_output=True, text=True, timeout=900, check=False)
    assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-1000:]
    skipped = [each for each in done.stdout.splitlines() if each.startswith("SKIPPED")]
    assert all(each.endswith(("not part of another rclpy", "recorded on Kilted")) for each in skipped)
    assert " passed" in done.stdout


@pytest.mark.parametrize(
    "which", [pytest.param(SOME, marks=pytest.mark.slow), pytest.param("", marks=pytest.mark.soak)], ids=["some", "all"]
)
def test_contract_suites_pass_on_foreign_rclpy(tmp_path: Path, which: str) -> None:
    ignored = [f"--ignore=tests/contract/test_{each}.py" for each in NEED_A_REAL_ONE]
    on_the_stand_in(tmp_path, "-k", which, "tests/contract", *ignored)


@pytest.mark.soak
def test_soak_passes_on_foreign_rclpy(tmp_path: Path) -> None:
    on_the_stand_in(
        tmp_path, "tests/soak", "--ignore=tests/soak/test_kept_stops_on_rclpy.py", BOT_CONSOLE_SOAK_MINUTES="0.5"
    )
