"""A stop holds until a person releases it, whatever ends and starts meanwhile; judged by a witness of the ground truth.

In one process: `tests/unit/tui/console/test_kept_stops.py`. Many runs beside busy processes: `witnessed_runs.py`.
"""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest

if os.name == "nt":
    pytest.skip("programs meet on Unix sockets", allow_module_level=True)

from processes.kept_stops import WAYS, Way, held_through
from processes.live_robot import LiveRobot, live_robot

pytestmark = pytest.mark.soak


@pytest.fixture
def robot(tmp_path: Path) -> Iterator[LiveRobot]:
    sockets = Path(tempfile.mkdtemp(prefix="bcs"))
    with live_robot(tmp_path, sockets, domain=78) as made:
        yield made
    shutil.rmtree(sockets, ignore_errors=True)


@pytest.mark.parametrize("way", WAYS, ids=lambda each: each.__name__)
def test_stop_holds_until_released_and_does_not_return(robot: LiveRobot, way: Way) -> None:
    held_through(way, robot)
