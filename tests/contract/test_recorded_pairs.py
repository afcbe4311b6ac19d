"""The backend of each pane sees the same of one scene as was recorded with our runtime, wherever the scene is played.

With BOT_CONSOLE_TESTS_RECORD=FOLDER, the result is also written there, for comparison with `recorded/`.
"""

from __future__ import annotations

import json
import os
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from bot_console.tui.console.robot import robot_drive
from domains import unused_domain
from rclpy.parameter import Parameter
from rigs import Rig, RosRig, machine_rig, mesh_rig, network_rig
from scenes.launcher_rigs import HostedRig, LauncherRig, MachineRig
from scenes.scene import play, play_launch

RECORDED = Path(__file__).parent / "recorded"
WAYS = [
    pytest.param(RosRig, id="embedded"),
    pytest.param(mesh_rig, id="mesh", marks=pytest.mark.soak),
    pytest.param(network_rig, id="network", marks=pytest.mark.soak),
    pytest.param(machine_rig, id="ros", marks=pytest.mark.ros),
]
LAUNCHERS = [
    pytest.param(HostedRig, id="embedded"),
    pytest.param(MachineRig, id="ros", marks=pytest.mark.ros),
]


@pytest.fixture
def rig(request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    monkeypatch.setenv("ROS_DOMAIN_ID", str(unused_domain()))
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "log"))
    if request.param is RosRig:
        monkeypatch.setattr(robot_drive, "LAST_ZERO_TIMEOUT_S", 0.0)
    made = request.param(tmp_path)
    yield made
    made.close()


def differences(recorded: Any, seen: Any, place: str = "") -> list[str]:
    """The differences between two recordings, one per line."""
    if isinstance(recorded, dict) and isinstance(seen, dict):
        found = [(recorded.get(key), seen.get(key), f"{place}/{key}") for key in sorted({*recorded, *seen})]
    elif isinstance(recorded, list) and isinstance(seen, list) and len(recorded) == len(seen):
        found = [
            (one, other, f"{place}/{number}") for number, (one, other) in enumerate(zip(recorded, seen, strict=True))
        ]
    else:
        return [] if recorded == seen else [f"{place}: recorded {recorded!r}, here {seen!r}"]
    return [line for one, other, where in found for line in differences(one, other, where)]


def as_printed_here(text: str) -> str:
    """Recorded refusals with types as this rclpy prints them: by name on Jazzy, by number on Kilted.

    Process ids are left out, since nodes of the embedded runtime have none.
    """
    text = text.replace(", pid N", "")
    return re.sub(r"\bType\.([A-Z_]+)", lambda found: f"{Parameter.Type[found[1]]}", text)


def compare(name: str, way: str, scene: Callable[[], Any]) -> None:
    seen = json.loads(json.dumps(scene()))
    if folder := os.environ.get("BOT_CONSOLE_TESTS_RECORD"):
        (Path(folder) / f"{name}-{way}.json").write_text(json.dumps(seen, indent=1) + "\n", encoding="utf-8")
    recorded = json.loads(as_printed_here((RECORDED / f"{name}.json").read_text(encoding="utf-8")))
    found = differences(recorded, seen)
    assert not found, "\n".join(found)


@pytest.mark.parametrize("rig", WAYS, indirect=True)
def test_panes_see_the_recorded_data(rig: Rig, request: pytest.FixtureRequest) -> None:
    compare("panes", request.node.callspec.id, lambda: play(rig))


@pytest.mark.parametrize("rig", LAUNCHERS, indirect=True)
def test_launch_pane_sees_the_recorded_data(rig: LauncherRig, request: pytest.FixtureRequest) -> None:
    compare("launch", request.node.callspec.id, lambda: play_launch(rig.launcher, rig.info, rig.settle, rig.path))
