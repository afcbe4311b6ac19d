"""The console's contract on an rclpy that is not ours: the stand-in, by the way that a machine with ROS 2 takes."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from fakes.standin_ros import make_standin

if os.name == "nt":
    pytest.skip("programs meet on Unix sockets", allow_module_level=True)

ROOT = Path(__file__).resolve().parents[3]
SOME = "graph or refusal or commands or logs_have or series_is_read"


@pytest.mark.parametrize("which", [SOME, pytest.param("", marks=pytest.mark.soak)], ids=["some", "all"])
def test_it_holds_on_the_stand_in(tmp_path: Path, which: str) -> None:
    environment = {**make_standin(tmp_path), "BOT_CONSOLE_TESTS_ON": "ros"}
    files = ["tests/contract/test_console.py", "tests/contract/test_parameters.py"]
    line = [sys.executable, "-m", "pytest", "-q", "-n", "0", "-m", "ros", "-k", which, *files]
    done = subprocess.run(line, cwd=ROOT, env=environment, capture_output=True, text=True, timeout=900, check=False)
    assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-1000:]
    assert "skipped" not in done.stdout and " passed" in done.stdout
