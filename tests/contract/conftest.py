"""Each promise is kept by the scripted system and by real ones, wherever their nodes are."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from bot_console.tui.console.connection import linked_console
from rigs import FakeRig, Rig, RosRig, machine_rig, mesh_rig, network_rig

WAYS = [
    pytest.param(FakeRig, id="fake"),
    pytest.param(RosRig, id="embedded"),
    pytest.param(mesh_rig, id="mesh"),
    pytest.param(network_rig, id="network", marks=pytest.mark.soak),
    pytest.param(machine_rig, id="ros", marks=pytest.mark.ros),
]
"""A network is tried often in `tests/unit/rmw/zenoh` and `acceptance/console/test_network_faults.py`.

The last one is for machines with a ROS 2: `BOT_CONSOLE_TESTS_ON=ros pytest -m ros tests/contract`."""


@pytest.fixture(params=WAYS)
def rig(request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Rig]:
    """A system with its console."""
    if request.param is RosRig:
        monkeypatch.setattr(linked_console, "LAST_WORD", 0.0)  # the bus in this process delivers at once
    made: Rig = request.param(tmp_path)
    yield made
    made.close()
