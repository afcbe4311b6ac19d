"""Hints that say where a parameter file is that was named by a path within its package."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from bot_console.runtime.rmw.arguments import ArgumentsError, parse
from bot_console.runtime.rmw.parameter_file import _finders, register_hint_source
from bot_console.runtime.workspace import parameter_files
from bot_console.runtime.workspace.discover import Workspace
from bot_console.runtime.workspace.parameter_files import hint_for


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """The folder of a workspace with one package, which is the working directory."""
    config = tmp_path / "src" / "mine" / "config"
    config.mkdir(parents=True)
    (config.parent / "package.xml").write_text("<package><name>mine</name></package>")
    (config / "robot.yaml").write_text("/**:\n  ros__parameters:\n    speed: 1.5\n")
    monkeypatch.chdir(tmp_path)
    found = Workspace([tmp_path / "src"])
    monkeypatch.setattr(parameter_files, "workspace", lambda: found)
    before = [*_finders]
    yield tmp_path
    _finders[:] = before


@pytest.mark.parametrize("named", ["config/robot.yaml", "./config/robot.yaml", "robot.yaml", "./robot.yaml"])
def test_hint_names_package_and_path_relative_to_working_directory(named: str) -> None:
    assert hint_for(named) == "package 'mine' has src/mine/config/robot.yaml"


def test_hint_has_absolute_path_outside_the_workspace(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (folder / "other").mkdir()
    monkeypatch.chdir(folder / "other")
    assert hint_for("config/robot.yaml") == f"package 'mine' has {folder}/src/mine/config/robot.yaml"


@pytest.mark.parametrize("named", ["config/nowhere.yaml", "/etc/config/robot.yaml", "config", "", ".."])
def test_no_hint_without_a_matching_file(named: str) -> None:
    assert hint_for(named) == ""


def test_command_line_error_includes_the_hint() -> None:
    register_hint_source(hint_for)
    with pytest.raises(ArgumentsError) as refused:
        parse(["--ros-args", "--params-file", "config/robot.yaml"])
    assert refused.value.hint.endswith("No such file or directory; package 'mine' has src/mine/config/robot.yaml")
