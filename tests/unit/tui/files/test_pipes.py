"""A pipe in the place of a file that is found by its name is refused or left out: opening it would wait for ever."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from bot_console.runtime.workspace.package import read_package
from bot_console.tui.cli.lint.run import files_of
from bot_console.tui.cli.verbs import background, editor
from bot_console.tui.learn.course import CourseError, read_course
from bot_console.tui.learn.files import WorkspaceFiles
from bot_console.tui.learn.progress import read_progress

pytestmark = pytest.mark.skipif(os.name == "nt", reason="needs named pipes")


@pytest.mark.parametrize("name", [editor.PYRIGHT, editor.VSCODE])
def test_settings_of_an_editor(tmp_path: Path, name: str, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / name).parent.mkdir(exist_ok=True)
    os.mkfifo(tmp_path / name)
    assert editor.run([str(tmp_path)]) == 1
    assert capsys.readouterr().err == f"not set up: {tmp_path / name}: it is not a regular file\n"


@pytest.mark.parametrize("name", ["setup.py", "setup.cfg", "CMakeLists.txt"])
def test_file_of_a_package(tmp_path: Path, name: str) -> None:
    build_type = "ament_cmake" if name == "CMakeLists.txt" else "ament_python"
    (tmp_path / "package.xml").write_text(
        f"<package><name>frog</name><export><build_type>{build_type}</build_type></export></package>"
    )
    os.mkfifo(tmp_path / name)
    assert read_package(tmp_path).problem == f"{tmp_path / name} is not a regular file"


def test_files_that_lint_and_a_course_look_at(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "hop.py")
    assert files_of(str(tmp_path)) == []
    assert WorkspaceFiles(tmp_path).text(tmp_path / "hop.py") == ""


def test_text_of_a_course(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "course.md")
    with pytest.raises(CourseError, match="it is not a regular file"):
        read_course(tmp_path)


def test_progress_of_a_course(tmp_path: Path) -> None:
    (tmp_path / ".bot-console").mkdir()
    os.mkfifo(tmp_path / ".bot-console" / "week6.json")
    assert "not a regular file" in read_progress(tmp_path, "week6").problem


def test_record_of_a_background_system(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "background.json")
    assert background._read(tmp_path / "background.json") is None
