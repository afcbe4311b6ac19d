"""Each promise is kept by the scripted system and by the real one."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from bot_console.tui.console import connection
from rigs import FakeRig, Rig, RosRig


@pytest.fixture(params=[FakeRig, RosRig], ids=["fake", "ros"])
def rig(request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Rig]:
    """A system with its console."""
    monkeypatch.setattr(connection, "LAST_WORD", 0.0)  # the bus in this process delivers at once
    made: Rig = request.param(tmp_path)
    yield made
    made.close()
