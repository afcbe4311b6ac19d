"""`--launch` takes a path, or a package and one of its launch files; errors are worded as `launch` does."""

from __future__ import annotations

from pathlib import Path

import pytest
from bot_console.runtime.workspace.discover import use, workspace
from bot_console.tui.cli.arguments import parse
from bot_console.tui.session.embedded.named_launch import with_launch_file
from ros2cli.command_line import main

PACKAGE = "<package format='3'><name>mine</name><version>0.0.0</version></package>"


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """A workspace with a package that has a launch file; returns its share folder."""
    before = workspace()
    folder = tmp_path / "ws" / "src" / "mine"
    (folder / "launch").mkdir(parents=True)
    (folder / "package.xml").write_text(PACKAGE)
    (folder / "launch" / "x.launch.py").write_text("")
    monkeypatch.chdir(tmp_path / "ws")
    yield folder
    use(before)


def resolve(*words: str) -> tuple[str, str]:
    options, problem = with_launch_file(parse(words))
    assert problem or not options.launch_file, "the launcher takes a path"
    return options.launch, problem


def test_package_and_launch_file_resolve_to_a_path_and_arguments(package: Path, tmp_path: Path) -> None:
    words = ["--workspace", str(tmp_path / "ws"), "--launch", "mine", "x.launch.py", "a:=1"]
    path, problem = resolve(*words)
    assert problem == "" and Path(path).samefile(package / "launch" / "x.launch.py") and Path(path).is_absolute()
    assert parse(words).launch_arguments == {"a": "1"}


def test_path_is_kept(package: Path) -> None:
    path = str(package / "launch" / "x.launch.py")
    assert resolve("--launch", path, "a:=1") == (path, "")
    assert resolve("indoor") == ("", "")


@pytest.mark.parametrize("words", [["nopkg", "x.launch.py"], ["mine", "y.launch.py"], ["mine"], ["./no", "x"]])
def test_missing_launch_file_is_reported_as_by_launch(
    package: Path, tmp_path: Path, words: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    problem = resolve("--workspace", str(tmp_path / "ws"), "--launch", *words)[1]
    assert main(["launch", *words]) == 1
    assert problem and capsys.readouterr().err.strip() == problem


def test_missing_path_is_not_taken_for_a_package() -> None:
    for path in ("nowhere.launch.py", "./nowhere"):
        assert resolve("--launch", path)[1] == f"there is no launch file {path}"
