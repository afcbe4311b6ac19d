"""A stop on a foreign rclpy holds until a person releases it, whatever process is killed meanwhile.

With an environment of `.ci/on_rclpy`:

    BOT_CONSOLE_TESTS_ON=ros python -m pytest -m ros tests/soak/test_kept_stops_on_rclpy.py

The nodes are those of the exported package, the console is `attach --ros`, and a witness judges by the ground truth.
"""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest
from domains import unused_domain
from processes.kept_stops import held_through
from processes.live_robot import LiveRobot, live_robot
from processes.ros_robot import RosRobot
from processes.ways_to_lose_stops import SCENARIOS
from rigs import is_embedded_rclpy

pytestmark = [
    pytest.mark.ros,
    pytest.mark.soak,
    pytest.mark.skipif(is_embedded_rclpy(), reason="needs rclpy on a machine without `ros2`: .ci/on_rclpy"),
]
TRIED = (
    "monitor killed", "monitor restarted", "base restarted", "both restarted", "both ended", "console killed",
    "console frozen", "simulator reset", "mouse flood", "key in a prompt", "unreadable stop file",
)  # fmt: skip
"""The ways that need no command line, launch file or network of the console's own."""


@pytest.fixture(scope="module")
def robot(tmp_path_factory: pytest.TempPathFactory) -> Iterator[LiveRobot]:
    sockets = Path(tempfile.mkdtemp(prefix="bcs"))
    try:
        with live_robot(tmp_path_factory.mktemp("robot"), sockets, unused_domain(), RosRobot) as made:
            yield made
    finally:
        shutil.rmtree(sockets, ignore_errors=True)


@pytest.mark.parametrize("name", TRIED)
def test_a_stop_holds_until_it_is_released_and_then_does_not_come_back(robot: LiveRobot, name: str) -> None:
    (scenario,) = (each for each in SCENARIOS if each.name == name)
    held_through(scenario, robot)
