"""An unwritable home, a deleted folder, an empty name: each is reported in one line, if at all."""

from __future__ import annotations

import errno
import os
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from bot_console.runtime.programs.exit_messages import run_and_report
from bot_console.tui.cli import open_console
from bot_console.tui.cli.arguments import parse
from bot_console.tui.cli.main import main
from bot_console.tui.cli.tune.pool import profile_yaml
from bot_console.tui.cli.verbs import background
from bot_console.tui.console.graph.expected import read_file
from bot_console.tui.files.folders import OVERRIDE
from bot_console.tui.session.embedded.named_profile import named_profile
from bot_console_robot.simulation_ros.worlds import find_world

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="Windows cannot delete a working folder")
MOVED = "the folder you are in was deleted; go to another one (cd) and try again\n"


@pytest.fixture
def no_home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A place where no user can create a folder."""
    (tmp_path / "file").touch()
    monkeypatch.setenv(OVERRIDE, str(tmp_path / "file" / "user"))
    return tmp_path / "file" / "user"


@pytest.fixture
def deleted_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "gone").mkdir()
    monkeypatch.chdir(tmp_path / "gone")
    (tmp_path / "gone").rmdir()


def test_console_needs_no_home(no_home: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    logs: list[Path] = []
    monkeypatch.setattr(open_console, "start_host", lambda words, log: logs.append(log))
    open_console._host(parse([]))
    assert logs == [Path(os.devnull)]


def test_background_system_reports_where_its_log_would_go(
    no_home: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(background, "take_part", lambda: "")
    monkeypatch.setattr(background, "running_robot_nodes", list)
    assert background.up([]) == 1
    message = capsys.readouterr().err
    assert message.startswith(f"not started: the log cannot be kept in {no_home}/state: ") and OVERRIDE in message


@pytest.mark.parametrize(
    "words",
    [["status"], ["down"], ["up"], ["stop"], ["bag", "record", "-a"], ["launch", "x.launch.py"], ["run", "x.py"],
     ["node", "list"], ["--headless"], ["--headless", "--fast"], ["graph"], ["reset"], ["lint", "running"]],
    ids=" ".join,
)  # fmt: skip
def test_invalid_domain_id_is_reported_in_one_line(
    words: list[str], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("ROS_DOMAIN_ID", "x")
    assert run_and_report(lambda: main(words)) != 0
    (line,) = capsys.readouterr().err.splitlines()
    assert "ROS_DOMAIN_ID is 'x', not a number" in line


LONG = "a" * 300


@pytest.mark.parametrize(
    "words",
    [["run", LONG], ["run", f"{LONG}.py"], ["lint", LONG], ["bag", "play", LONG], ["bag", "info", LONG],
     ["pkg", "create", LONG], ["launch_test", LONG]],
    ids=lambda words: " ".join(words[:-1]),
)  # fmt: skip
def test_too_long_file_name_is_reported_in_one_line(
    words: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run_and_report(lambda: main(words)) == 1
    (line,) = [each for each in capsys.readouterr().err.splitlines() if "too long" in each]
    assert "'" + "a" * 30 in line.replace("./", "") and len(line) < 200


def test_too_long_launch_path_is_taken_for_a_package() -> None:
    assert parse(["--launch", LONG, "robot.launch.py"]).launch == LONG


@pytest.mark.parametrize("words", [["--headless"], [], ["--launch", "x.launch.py"]])
def test_run_in_a_deleted_folder_is_refused_in_one_line(
    words: list[str], deleted_folder: None, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run_and_report(lambda: main(words)) == 1
    assert capsys.readouterr().err.endswith(MOVED)


def test_export_from_a_deleted_folder_is_reported(deleted_folder: None, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["export", "x"])
    assert capsys.readouterr().err == f"not exported: {MOVED}"


def test_empty_name_is_not_a_launch_file(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        parse(["--launch", ""])
    assert "--launch: give the name of a launch file" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "reported"),
    [
        (["--launch", __file__, "more"], "malformed launch argument 'more', expected format '<name>:=<value>'"),
        (["--launch", "package", "x.launch.py", "more"], "malformed launch argument 'more', expected"),
        (["--launch", "package", "outdoor"], "give either a profile or --launch"),
        (["--launch", "package", "x.launch.py", "--profile", "outdoor"], "give either a profile or --launch"),
    ],
)
def test_extra_words_after_launch_are_reported(
    capsys: pytest.CaptureFixture[str], words: list[str], reported: str
) -> None:
    with pytest.raises(SystemExit):
        parse(words)
    assert reported in capsys.readouterr().err


def test_empty_name_is_not_a_profile(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        parse(["--profile", ""])
    assert "there is no profile and no command ''; profiles: " in capsys.readouterr().err


def test_empty_name_is_not_a_check_script(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["check", ""])
    assert "name a script" in capsys.readouterr().err


@pytest.mark.parametrize("words", [[], ["attach"], ["--profile", "indoor"]])
def test_unsupported_system_is_reported_with_alternatives(
    words: list[str], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "termios", None)
    assert main(words) == 1
    assert capsys.readouterr().err == (
        "the console needs a Linux or macOS terminal: on Windows, start it in WSL, "
        "or use `bot-console --headless` and the verbs of ros2\n"
    )


@pytest.mark.parametrize("words", [["info", ""], ["play", ""], ["open", ""], ["record", "-o", "", "-a"]])
def test_empty_name_is_not_a_bag(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["bag", *words])
    assert ended.value.code == 2 and "the name of the bag is empty" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("error", "word"),
    [
        (MemoryError(), "memory"),
        (OSError(errno.ENOMEM, "Cannot allocate memory"), "memory"),
        (OSError(errno.EMFILE, "Too many open files", "some file"), "ulimit -n"),
        (RuntimeError("can't start new thread"), "ulimit -u"),
    ],
    ids=repr,
)
def test_process_limit_is_reported_in_one_line(error: Exception, word: str, capsys: pytest.CaptureFixture[str]) -> None:
    def run() -> int:
        raise error

    assert run_and_report(run) == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert word in line


def test_other_errors_are_raised_unchanged() -> None:
    def run() -> int:
        raise RuntimeError("a mistake")

    with pytest.raises(RuntimeError, match="a mistake"):
        run_and_report(run)


@pytest.mark.parametrize("read", [named_profile, find_world, read_file, profile_yaml, lambda word: parse([word])])
def test_file_below_the_home_of_an_unknown_user_is_refused_like_any_missing_file(read: Callable[[str], object]) -> None:
    with pytest.raises((ValueError, OSError, SystemExit)):
        read("~nobody of that name/a.yaml")
