"""Which package is run if two have the same name."""

from __future__ import annotations

from types import SimpleNamespace

import pytest
from bot_console.runtime.workspace.builtin_package import NAME
from bot_console.tui.session.embedded import workspaces


def test_workspace_package_with_our_name_is_reported(monkeypatch, capsys, tmp_path):
    own = SimpleNamespace(folder=tmp_path)
    monkeypatch.setattr(workspaces, "workspace", lambda: SimpleNamespace(packages={NAME: own}))
    monkeypatch.setattr(workspaces, "is_own", lambda found: False)
    workspaces.report_workspace(NAME)
    assert f"package '{NAME}' is the one in {tmp_path}" in capsys.readouterr().err


@pytest.mark.parametrize("named", ["", "my_node.py", "my_package"])
def test_no_folder_is_searched_for_another_name(named, monkeypatch):
    class Unsearched:
        @property
        def packages(self):
            pytest.fail("searched for packages")

    monkeypatch.setattr(workspaces, "workspace", Unsearched)
    workspaces.report_workspace(named)


def test_launch_files_of_own_packages_come_before_bundled_ones(monkeypatch):
    packages = {"demo": "tutorials", "mine": "mine", NAME: "ours"}
    monkeypatch.setattr(workspaces, "workspace", lambda: SimpleNamespace(packages=packages))
    monkeypatch.setattr(workspaces, "is_own", "ours".__eq__)
    monkeypatch.setattr(workspaces, "is_demo", "tutorials".__eq__)
    monkeypatch.setattr(workspaces, "launch_file_paths", lambda name: [f"{name}.launch.py"])
    assert workspaces.launch_files() == ("mine.launch.py", "demo.launch.py", f"{NAME}.launch.py")
