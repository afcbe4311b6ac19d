"""Whose package is run, where two have one name."""

from __future__ import annotations

from types import SimpleNamespace

import pytest
from bot_console.runtime.workspace.builtin_package import NAME
from bot_console.tui.cli.system import workspaces


def test_a_package_of_our_name_is_reported(monkeypatch, capsys, tmp_path):
    own = SimpleNamespace(folder=tmp_path)
    monkeypatch.setattr(workspaces, "workspace", lambda: SimpleNamespace(packages={NAME: own}))
    monkeypatch.setattr(workspaces, "is_own", lambda found: False)
    workspaces.report_workspace(NAME)
    assert f"package '{NAME}' is the one in {tmp_path}" in capsys.readouterr().err


@pytest.mark.parametrize("named", ["", "my_node.py", "my_package"])
def test_for_another_name_no_folder_is_searched(named, monkeypatch):
    class Unsearched:
        @property
        def packages(self):
            pytest.fail("packages were looked for")

    monkeypatch.setattr(workspaces, "workspace", Unsearched)
    workspaces.report_workspace(named)


def test_launch_files_of_ones_own_packages_stand_before_those_that_come_along(monkeypatch):
    packages = {"demo": "tutorials", "mine": "mine", NAME: "ours"}
    monkeypatch.setattr(workspaces, "workspace", lambda: SimpleNamespace(packages=packages))
    monkeypatch.setattr(workspaces, "is_own", "ours".__eq__)
    monkeypatch.setattr(workspaces, "is_demo", "tutorials".__eq__)
    monkeypatch.setattr(workspaces, "launch_file_paths", lambda name: [f"{name}.launch.py"])
    assert workspaces.launch_files() == ("mine.launch.py", "demo.launch.py", f"{NAME}.launch.py")
