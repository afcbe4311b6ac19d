"""`--distro kilted` and `BOT_CONSOLE_DISTRO` give the results of the real rclpy of Kilted."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from helpers.recorded.releases import LIVE
from rigs import is_embedded_rclpy

PROGRAM = str(LIVE / "kilted_answers.py")
RECORDED = LIVE / "kilted_answers.txt"
"""The output of the program on the rclpy 9.1.2 of PyPI."""
OURS = str(Path(sys.executable).with_name("bot-console"))


def run_program(*words: str, **environment: str) -> str:
    environment = {**os.environ, **environment}
    run = subprocess.run([*words, PROGRAM], env=environment, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr
    return run.stdout


@pytest.mark.skipif(not is_embedded_rclpy(), reason="tests our rclpy")
@pytest.mark.parametrize(
    ("words", "environment"),
    [
        (["--distro", "kilted", "run"], {}),
        pytest.param(["--distro=kilted", "run"], {}, marks=pytest.mark.slow),
        pytest.param(["run"], {"BOT_CONSOLE_DISTRO": "kilted"}, marks=pytest.mark.slow),
    ],
    ids=["option", "option with =", "variable"],
)
def test_results_equal_those_of_kilted(words: list[str], environment: dict[str, str]) -> None:
    assert run_program(OURS, *words, **environment) == RECORDED.read_text("utf-8")


@pytest.mark.ros
@pytest.mark.skipif(is_embedded_rclpy(), reason="needs the rclpy of PyPI: .ci/on_rclpy")
@pytest.mark.skipif(os.environ.get("BOT_CONSOLE_TESTS_DISTRO") != "kilted", reason="recorded on Kilted")
def test_real_rclpy_gives_the_recorded_results() -> None:
    assert run_program(sys.executable) == RECORDED.read_text("utf-8")
