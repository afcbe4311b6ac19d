"""`interface add`: what is stored, what is refused, and which definition takes precedence."""

from __future__ import annotations

import importlib
from pathlib import Path

import pytest
from bot_console.runtime.interfaces import further_interfaces
from bot_console.runtime.workspace import discover


def package(folder: Path, name: str, **files: str) -> Path:
    """Create a package of interfaces; `msg_Num="int32 a"` becomes `msg/Num.msg`."""
    for key, text in files.items():
        kind, _, stem = key.partition("_")
        path = folder / name / kind / f"{stem}.{kind}"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    (folder / name / "package.xml").write_text(f"<package><name>{name}</name></package>")
    return folder / name


def test_added_interfaces_stay_after_their_folder_is_deleted(ros, tmp_path: Path) -> None:
    checkout = tmp_path / "checkout"
    package(checkout, "kept_one_msgs", msg_Num="int32 number 7\n")
    package(checkout, "kept_two_msgs", srv_Ask="kept_one_msgs/Num num\n---\n")
    added = ros.ask("interface", "add", str(checkout))
    assert (added.exit, added.stdout) == (0, "added kept_one_msgs: msg/Num\nadded kept_two_msgs: srv/Ask\n")
    (checkout / "kept_one_msgs" / "msg" / "Num.msg").unlink()
    assert importlib.import_module("kept_two_msgs.srv").Ask.Request().num.number == 7
    assert ros.ask("interface", "package", "kept_one_msgs").stdout == "kept_one_msgs/msg/Num\n"


@pytest.mark.parametrize(
    ("name", "files", "refusal"),
    [
        ("std_msgs", {"msg_Num": "int32 a\n"}, "std_msgs is included and used by everything"),
        ("broken_msgs", {"msg_Good": "int32 a\n", "srv_Bad": "int32 badName\n---\n"}, "Bad.srv"),
        ("empty", {}, "has no package with definitions"),
    ],
)
def test_invalid_packages_are_refused(ros, tmp_path: Path, name: str, files: dict[str, str], refusal: str) -> None:
    (tmp_path / name).mkdir()
    package(tmp_path, name, **files)
    refused = ros.ask("interface", "add", str(tmp_path / name))
    assert refused.exit == 1
    assert "nothing added: " in refused.stderr and refusal in refused.stderr
    assert not further_interfaces.added_by_user()


def test_missing_folder_is_reported(ros, tmp_path: Path) -> None:
    assert "is not a folder" in ros.ask("interface", "add", str(tmp_path / "nowhere")).stderr


def test_workspace_definition_takes_precedence(ros, tmp_path: Path) -> None:
    package(tmp_path, "nav2_msgs", msg_Particle="float64 only_mine\n")
    before = discover.workspace()
    discover.use(discover.Workspace([tmp_path]))
    try:
        shown = ros.ask("interface", "show", "nav2_msgs/msg/Particle")
    finally:
        discover.use(before)
    assert (shown.stdout, shown.stderr) == ("float64 only_mine\n", "")


def test_show_warns_if_type_hash_was_not_compared(ros) -> None:
    shown = ros.ask("interface", "show", "nav2_msgs/msg/SpeedLimit")
    assert "float64 speed_limit\n" in shown.stdout
    assert "its type hash was not compared with ROS 2" in shown.stderr
    assert ros.ask("interface", "show", "std_msgs/msg/String").stderr == ""
