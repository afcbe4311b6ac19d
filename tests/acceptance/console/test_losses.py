"""A robot that loses its operator stands until a person hands it back; a witness judges this by the odometry.

The default run kills a program that steers, in stepped time: `robot/test_emergency_stop.py`.
"""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

if os.name == "nt":
    pytest.skip("needs Unix sockets", allow_module_level=True)

from processes.live_robot import LiveRobot, live_robot
from processes.losses import PERSONS, STOPS


@pytest.fixture(scope="module")
def robot(tmp_path_factory: pytest.TempPathFactory) -> Iterator[LiveRobot]:
    """A live robot, driving; each loss leaves it as it was."""
    sockets = Path(tempfile.mkdtemp(prefix="bcs"))
    with live_robot(tmp_path_factory.mktemp("robot"), sockets) as made:
        yield made
    shutil.rmtree(sockets, ignore_errors=True)


@pytest.mark.soak
@pytest.mark.parametrize("loss", (*PERSONS, *STOPS), ids=lambda each: each.__name__)
def test_robot_that_lost_its_operator_stands_until_handed_back(
    robot: LiveRobot, loss: Callable[[LiveRobot], float]
) -> None:
    loss(robot)
