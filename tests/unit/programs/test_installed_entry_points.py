"""A package with damaged files offers nothing, and takes nothing away from others."""

from __future__ import annotations

import sys
from importlib.metadata import EntryPoint
from pathlib import Path

import pytest
from bot_console.runtime.programs.installed_entry_points import installed_entry_points, package_of
from bot_console.tui.session.plugins import find_plugins
from launch.frontend import parser
from launch_ros.component_container import find_component

GROUPS = ("bot_console.panes", "rclpy_components", "launch.frontend.launch_extension")
POINTS = "".join(f"[{group}]\nwell = logging:Logger\n" for group in GROUPS)
DAMAGES = {
    "entry point without a value": {"entry_points.txt": b"[bot_console.panes]\nodd\n"},
    "entry points that are not text": {"entry_points.txt": b"[x]\na = \xff\n"},
    "metadata that is not text": {"entry_points.txt": b"[bot_console.panes]\nodd = a:B\n", "METADATA": b"Name: \xff\n"},
    "no metadata": {"entry_points.txt": b"[bot_console.panes]\nodd = a:B\n"},
}


@pytest.fixture(params=DAMAGES.values(), ids=list(DAMAGES))
def path(request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A path with a damaged package and an intact one."""
    well = {"entry_points.txt": POINTS.encode(), "METADATA": b"Metadata-Version: 2.1\nName: well\nVersion: 1\n"}
    for name, files in (("odd", request.param), ("well", well)):
        folder = tmp_path / f"{name}-1.dist-info"
        folder.mkdir()
        for file, content in files.items():
            (folder / file).write_bytes(content)
    monkeypatch.setattr(sys, "path", [str(tmp_path)])


@pytest.mark.usefixtures("path")
def test_panes_of_other_packages_are_found() -> None:
    found = {each.id: each.source for each in find_plugins()}
    assert found["plugin_well"] == "well"
    assert found.get("plugin_odd", "a:B") == "a:B"


@pytest.mark.usefixtures("path")
def test_components_and_extensions_of_launch_are_found(monkeypatch: pytest.MonkeyPatch) -> None:
    assert find_component("logging", "well").__name__ == "Logger"
    loaded: list[str] = []
    monkeypatch.setattr(EntryPoint, "load", lambda point: loaded.append(point.name))
    parser._load_extensions.__wrapped__()
    assert loaded == ["well"]


@pytest.mark.usefixtures("path")
def test_packages_are_named() -> None:
    (well,) = installed_entry_points("rclpy_components")
    assert (well.name, package_of(well)) == ("well", "well")
