"""`bot-console export`: a package for colcon; nothing is lost in an existing folder."""

from __future__ import annotations

import builtins
import sys
from pathlib import Path
from typing import Any

import pytest
from bot_console.runtime.workspace.exporting import NAME
from bot_console.tui.cli.verbs.export import run
from launch.launch_description_sources import get_launch_description_from_python_launch_file
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_ros.actions import Node

from launch import LaunchContext


def contents(place: Path) -> dict[str, bytes]:
    return {str(each.relative_to(place)): each.read_bytes() for each in place.rglob("*") if each.is_file()}


def answer_prompt(monkeypatch: pytest.MonkeyPatch, answer: str) -> None:
    monkeypatch.setattr(sys.stdin, "isatty", lambda: True, raising=False)
    monkeypatch.setattr(builtins, "input", lambda _: answer)


def test_export_asks_before_writing_into_existing_folder_and_deletes_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run([str(tmp_path)]) == 0
    place = tmp_path / NAME
    fresh = contents(place)
    assert {"package.xml", "setup.py", f"{NAME}/robot_node.py"} <= fresh.keys()
    (place / "setup.py").write_text("# mine\n")
    (place / "notes.txt").write_text("mine")
    (place / "package.xml").unlink()
    before = contents(place)

    with pytest.raises(SystemExit):
        run([str(tmp_path)])
    assert "exists already; give another folder" in capsys.readouterr().err
    answer_prompt(monkeypatch, "")
    with pytest.raises(SystemExit):
        run([str(tmp_path)])
    assert contents(place) == before

    answer_prompt(monkeypatch, "y")
    assert run([str(tmp_path)]) == 0
    assert "kept with ~ appended to their names: setup.py" in capsys.readouterr().out
    assert contents(place) == fresh | {"notes.txt": b"mine", "setup.py~": b"# mine\n"}


@pytest.fixture(scope="module")
def exported(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The exported package, which no test changes."""
    folder = tmp_path_factory.mktemp("export")
    run([str(folder)])
    return folder / NAME


def test_each_profile_is_exported_once(exported: Path) -> None:
    names = sorted(each.stem for each in (exported / "config").iterdir())
    assert names == [f"{each}_config" for each in ("competition", "indoor", "outdoor", "warehouse")]
    readme = (exported / "README.md").read_text()
    assert "| parameter | competition | indoor | outdoor | warehouse |" in readme and "config |" not in readme


def test_invalid_navigator_argument_is_refused(exported: Path) -> None:
    description = get_launch_description_from_python_launch_file(str(exported / "launch/robot_system.launch.py"))
    context = LaunchContext()
    context.launch_configurations["navigator"] = "mine"
    with pytest.raises(RuntimeError, match="navigator:=mine: expected true, false, goals or a Python file"):
        for entity in description.entities:
            if not isinstance(entity, Node):
                entity.execute(context)


@pytest.mark.parametrize(
    ("launch_file", "words"),
    [("robot_system.launch.py", {"navigator": "my_node.py"}), ("program.launch.py", {"program": "my_node.py"})],
)
def test_user_file_need_not_be_executable_on_real_ros(exported: Path, launch_file: str, words: dict[str, str]) -> None:
    file = exported / "launch" / launch_file
    description = get_launch_description_from_python_launch_file(str(file))
    context = LaunchContext()
    context.launch_configurations.update(words)
    made: list[Any] = []
    for entity in description.entities:
        if not isinstance(entity, Node):
            made += entity.execute(context) or ()
    (mine,) = [
        each
        for each in made
        if isinstance(each, Node) and _perform(context, each.process_description.cmd[0]) == "my_node.py"
    ]
    assert _perform(context, mine.process_description.prefix) == "python3"
    assert _perform(context, mine.process_description.name) == "my_node.py"


def _perform(context: LaunchContext, text: Any) -> str:
    return perform_substitutions(context, normalize_to_list_of_substitutions(text))


def test_unwritable_place_is_reported_in_one_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "file").write_text("mine")
    for folder, why in ((str(tmp_path / "file"), "not a directory"), ("", "give a file name")):
        with pytest.raises(SystemExit):
            run([folder])
        error = capsys.readouterr().err
        assert why in error and error.count("\n") == 1
