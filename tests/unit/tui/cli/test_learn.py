"""`learn` and `lint` of a course without a screen."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from bot_console.tui.cli.learn import run
from bot_console.tui.cli.lint.run import run as lint
from bot_console.tui.learn.command_log import open_log, read_log
from processes.command_line import run_cli


def test_list_shows_steps_and_what_the_next_one_still_needs(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["--list", "--workspace", str(tmp_path)]) == 0
    printed = capsys.readouterr().out
    assert "○ A node with a parameter" in printed
    assert f"there is no file *.py in {tmp_path}" in printed


def test_new_course_lints_and_lists(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["--new", str(tmp_path / "c")]) == 0
    assert lint([str(tmp_path / "c")]) == 0
    assert "nothing found in 1 chapter, 1 step and 1 row of grading" in capsys.readouterr().err
    assert run([str(tmp_path / "c"), "--list", "--workspace", str(tmp_path)]) == 0
    assert "0 of 1 done" in capsys.readouterr().out


def test_new_course_never_replaces_a_folder(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["--new", str(tmp_path)]) == 1
    assert capsys.readouterr().err == f"not written: {tmp_path}: File exists\n"


def test_lint_names_the_line_of_a_mistake(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    run(["--new", str(tmp_path / "c")])
    chapter = tmp_path / "c" / "01-first-chapter.md"
    chapter.write_text(chapter.read_text("utf-8").replace("saw-set", "saw-sett"), "utf-8")
    assert lint([str(tmp_path / "c")]) == 1
    assert f"{chapter}:15: 'saw-sett' is not one of" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "code", "text"),
    [
        (["nowhere"], 2, "there is no course 'nowhere'; the courses are week6"),
        (["--workspace", "nowhere"], 1, "there is no folder nowhere: make it (`mkdir -p nowhere/src`)"),
    ],
)
def test_missing_course_or_workspace_is_named(
    words: list[str], code: int, text: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(words) == code
    assert text in capsys.readouterr().err


def test_recorded_exit_code_is_the_one_of_the_process(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("BOT_CONSOLE_SOCKET_DIR", str(tmp_path))
    log = open_log()
    codes = [
        run_cli(*words).returncode
        for words in (["lint", "--help"], ["lint", "--nonsense"], ["stop", "--help"], ["--version"])
    ]
    assert codes == [0, 2, 0, 0]
    assert [(each.words[0], each.code) for each in read_log(log)] == [("lint", 0), ("lint", 2)]
    os.remove(log)
    run_cli("lint", "--help")
    assert not os.path.exists(log)
