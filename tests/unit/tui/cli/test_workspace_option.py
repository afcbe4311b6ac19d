"""`--workspace DIR` before and after the name of a command."""

from __future__ import annotations

from pathlib import Path

import pytest
from bot_console.tui.cli import workspace_option
from bot_console.tui.cli.main import main
from bot_console.tui.cli.workspace_option import NoWorkspaceError, without_workspace

LAUNCH = ["launch", "my_package", "x.launch.py", "speed:=1"]


@pytest.fixture
def used_folders(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The folders that became the workspace."""
    folders: list[str] = []
    monkeypatch.setattr(workspace_option, "use_folders", folders.extend)
    return folders


@pytest.mark.parametrize(
    ("typed", "folders", "left"),
    [
        ("--workspace ws launch my_package x.launch.py speed:=1", ["ws"], LAUNCH),
        ("launch --workspace ws my_package x.launch.py speed:=1", ["ws"], LAUNCH),
        ("launch my_package x.launch.py --workspace=ws speed:=1", ["ws"], LAUNCH),
        ("--workspace a launch --workspace b my_package x.launch.py speed:=1", ["a", "b"], LAUNCH),
        ("launch my_package x.launch.py speed:=1", [], LAUNCH),
        ("run --workspace ws my_package node", ["ws"], ["run", "my_package", "node"]),
        ("run my_package node --workspace ws", [], ["run", "my_package", "node", "--workspace", "ws"]),
        ("--workspace ws pkg list", ["ws"], ["pkg", "list"]),
        ("--workspace ws up outdoor", [], ["up", "--workspace", "ws", "outdoor"]),
        ("--workspace ws --launch my_package x", [], ["--workspace", "ws", "--launch", "my_package", "x"]),
        ("--workspace ws outdoor", [], ["--workspace", "ws", "outdoor"]),
        ("launch x.launch.py --workspace", [""], ["launch", "x.launch.py"]),
    ],
)
def test_option_is_taken_only_before_or_after_the_command_name(
    used_folders: list[str], typed: str, folders: list[str], left: list[str]
) -> None:
    commands = ("launch", "run", "pkg", "up")
    assert without_workspace(typed.split(), commands.__contains__) == left
    assert used_folders == folders


def test_missing_folder_is_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    nowhere = str(tmp_path / "nowhere")
    with pytest.raises(NoWorkspaceError, match="there is no folder"):
        without_workspace(["--workspace", nowhere, "pkg", "list"], "pkg".__eq__)
    for words in (["pkg", "--workspace", nowhere, "list"], ["ros2", "launch", "p", f"--workspace={nowhere}"]):
        assert main(words) == 2
        assert capsys.readouterr().err == f"bot-console: --workspace: there is no folder {nowhere}\n"
