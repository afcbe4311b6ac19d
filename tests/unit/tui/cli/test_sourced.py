"""`install/setup.bash` after `colcon build`, sourced as in tutorials; it never overwrites another colcon's file."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest
from bot_console.runtime.workspace import discover
from bot_console.tui.cli.verbs import sourced as verb
from bot_console.tui.cli.verbs.colcon import run
from bot_console.tui.cli.verbs.sourced import write_setup_files


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    package = tmp_path / "a space" / "src" / "mine"
    package.mkdir(parents=True)
    (package / "package.xml").write_text("<package><name>mine</name></package>")
    (tmp_path / "empty").mkdir()
    monkeypatch.delenv(discover.SOURCED_VARIABLE, raising=False)
    monkeypatch.setattr(discover, "_current", [])
    monkeypatch.chdir(tmp_path / "a space")
    return tmp_path / "a space"


def sourced(folder: Path, *, before: str = "") -> str:
    script = (
        '. install/setup.bash; . install/setup.bash; printf "%s\\n" "$BOT_CONSOLE_WORKSPACE" "$BOT_CONSOLE_COMMAND"'
    )
    environment = {**os.environ, discover.SOURCED_VARIABLE: before}
    return subprocess.run(
        ["bash", "-c", script], cwd=folder, env=environment, capture_output=True, text=True, check=True
    ).stdout


def test_setup_file_adds_ros2_and_workspace_to_shell_once(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["build"]) == 0
    assert "install/setup.bash makes the ros2 command" in capsys.readouterr().out
    names, command = sourced(folder).splitlines()
    assert names == str(folder) and command.endswith("bot-console")
    assert (folder / "install" / "COLCON_IGNORE").exists()


def test_setup_file_puts_workspace_before_those_sourced_earlier(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(verb, "command", lambda: "true")
    assert run(["build"]) == 0
    assert sourced(folder, before="/other").splitlines()[0] == f"{folder}:/other"


def test_packages_of_sourced_workspace_are_found_after_local_ones(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(folder.parent / "empty")
    assert "mine" not in discover.workspace().packages
    monkeypatch.setattr(discover, "_current", [])
    monkeypatch.setenv(discover.SOURCED_VARIABLE, f"/nowhere{os.pathsep}{folder}")
    assert discover.workspace().packages["mine"].folder == folder / "src" / "mine"


def test_files_of_another_colcon_are_kept_and_nothing_is_written_without_packages(folder: Path) -> None:
    (folder / "install").mkdir()
    other = folder / "install" / "setup.bash"
    other.write_text("# generated from colcon_bash/shell/template/prefix_chain.bash.em\n")
    write_setup_files(folder, discover.workspace())
    assert other.read_text().startswith("# generated from colcon_bash")
    assert write_setup_files(folder.parent / "empty", discover.workspace()) == ()
    assert not (folder.parent / "empty" / "install").exists()


def test_failed_build_or_another_verb_writes_nothing(folder: Path) -> None:
    assert run(["list"]) == 1
    (folder / "src" / "mine" / "setup.py").write_text("setup(\n")
    discover.use(discover.Workspace([folder]))
    assert run(["build"]) == 1
    assert not (folder / "install").exists()
