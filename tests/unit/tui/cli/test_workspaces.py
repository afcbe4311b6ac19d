"""Whose package is run, where two have one name."""

from __future__ import annotations

from types import SimpleNamespace

import pytest
from bot_console.runtime.workspace.own import NAME
from bot_console.tui.cli.system import workspaces


def test_a_package_of_our_name_is_told(monkeypatch, capsys, tmp_path):
    own = SimpleNamespace(folder=tmp_path)
    monkeypatch.setattr(workspaces, "workspace", lambda: SimpleNamespace(packages={NAME: own}))
    monkeypatch.setattr(workspaces, "is_own", lambda found: False)
    workspaces.tell_whose(NAME)
    assert f"package '{NAME}' is the one in {tmp_path}" in capsys.readouterr().err


@pytest.mark.parametrize("named", ["", "my_node.py", "my_package"])
def test_for_another_name_no_folder_is_searched(named, monkeypatch):
    class Unsearched:
        @property
        def packages(self):
            pytest.fail("packages were looked for")

    monkeypatch.setattr(workspaces, "workspace", Unsearched)
    workspaces.tell_whose(named)
