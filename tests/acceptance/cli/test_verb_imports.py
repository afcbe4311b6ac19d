"""The modules that a verb imports in a second terminal: each of those listed here takes a twentieth of its time."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from helpers.processes.two_processes import two_processes

PROGRAM = "from bot_console.tui.cli.main import program; program()"
TIMEOUT_S = 240.0
"""Seconds after which a verb counts as hanging."""

HEAVY = {
    "asyncio",
    "dataclasses",
    "datetime",
    "importlib.metadata",
    "inspect",
    "locale",
    "logging",
    "numpy",
    "pathlib",
    "platformdirs",
    "random",
    "rich",
    "shutil",
    "subprocess",
    "tempfile",
    "textual",
    "traceback",
    "yaml",
}


@pytest.mark.parametrize(
    ("words", "more"),
    [
        pytest.param("node list", {"hashlib", "bot_console.runtime.rosidl.cdr_layout"}, marks=pytest.mark.slow),
        pytest.param("topic list", {"hashlib", "bot_console.runtime.rosidl.cdr_layout"}, marks=pytest.mark.slow),
        ("param get /other/peer speed", {"hashlib"}),
        pytest.param("param set /other/peer speed 2.5", {"hashlib"}, marks=pytest.mark.slow),
        pytest.param("service call /pull std_srvs/srv/Trigger", set[str](), marks=pytest.mark.slow),
        pytest.param("topic echo --once /poor", set[str](), marks=pytest.mark.slow),
    ],
)
def test_verb_imports_nothing_heavy(tmp_path: Path, words: str, more: set[str]) -> None:
    with two_processes(tmp_path / "s"):
        asked = subprocess.run(
            [sys.executable, "-X", "importtime", "-c", PROGRAM, *words.split()],
            env=dict(os.environ),
            capture_output=True,
            text=True,
            timeout=TIMEOUT_S,
            check=False,
        )
    imported = set(re.findall(r"^import time:.*\| +([\w.]+)$", asked.stderr, re.MULTILINE))
    assert asked.returncode == 0, asked.stderr
    assert "rclpy.node" in imported
    assert imported & (HEAVY | more) == set()
