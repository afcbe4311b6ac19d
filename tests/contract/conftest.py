"""Runs each contract on the scripted system and on real ones, however their nodes are connected."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

import pytest
from bot_console.tui.console.robot import robot_drive
from rigs import FakeRig, Rig, RosRig, is_embedded_rclpy, machine_rig, mesh_rig, network_rig

WAYS = [
    pytest.param(FakeRig, id="fake"),
    pytest.param(RosRig, id="embedded"),
    pytest.param(mesh_rig, id="mesh"),
    pytest.param(network_rig, id="network", marks=pytest.mark.soak),
    pytest.param(machine_rig, id="ros", marks=pytest.mark.ros),
]
"""Networks are mostly tested in `tests/unit/rmw/zenoh` and `acceptance/console/test_network_faults.py`.

The last rig is for machines with a ROS 2: `BOT_CONSOLE_TESTS_ON=ros pytest -m ros tests/contract`.
"""

HERE = Path(__file__).parent

OURS = {
    "test_other_implementation.py": "the Zenoh sessions of our middleware, beside another implementation of its format",
    "test_reopened.py": "the Zenoh sessions of our middleware are reopened",
    "test_seals.py": "the seals that our middleware adds to messages",
    "test_two_processes.py": "two processes that meet over our middleware",
}
"""Files that test only features of our runtime, with the reason why they are skipped on another rclpy."""


class SkippedFile(pytest.Module):
    """A file whose imports may be missing on another rclpy."""

    def collect(self) -> Iterable[pytest.Item | pytest.Collector]:
        """Skip the file with a one-line reason."""
        pytest.skip(f"{OURS[self.path.name]}: not part of another rclpy")


def pytest_pycollect_makemodule(module_path: Path, parent: pytest.Collector) -> pytest.Module | None:
    """Skip the files of `OURS` if `rclpy` is not ours."""
    if is_embedded_rclpy() or module_path.name not in OURS:
        return None
    return SkippedFile.from_parent(parent, path=module_path)


ONCE = ("mesh", "hosted", "attached")
"""Rigs on which the default run tries only the first of several values: the values do not depend on the rig."""


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark the tests that the default run leaves to the run of the slow tests."""
    begun: set[tuple[Path, str, str]] = set()
    for each in items:
        if isinstance(each, pytest.Function) and each.path.parent == HERE and hasattr(each, "callspec"):
            way, _, value = each.callspec.id.partition("-")
            test = (each.path, each.originalname, way)
            if value and way in ONCE and test in begun:
                each.add_marker(pytest.mark.slow)
            begun.add(test)


@pytest.fixture(params=WAYS)
def rig(request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Rig]:
    """A system with its console."""
    if request.param is RosRig:
        monkeypatch.setattr(robot_drive, "LAST_ZERO_TIMEOUT_S", 0.0)  # the bus in this process delivers at once
    made: Rig = request.param(tmp_path)
    yield made
    made.close()
