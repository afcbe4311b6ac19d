"""Errors in a command line are reported on one line, which says what is possible."""

from __future__ import annotations

from pathlib import Path

import pytest
from bot_console.tui.cli.main import main


def usage_error(words: list[str], capsys: pytest.CaptureFixture[str]) -> str:
    """The last line of stderr of a command line that is refused as wrong usage."""
    with pytest.raises(SystemExit) as ended:
        main(words)
    assert ended.value.code == 2
    return capsys.readouterr().err.splitlines()[-1]


@pytest.mark.parametrize(
    ("words", "similar"),
    [("lanch", "launch"), ("lanch my_package my.launch.py", "launch"), ("atach", "attach"), ("topci list", "topic"),
     ("outdor", "outdoor"), ("--headless outdor", "outdoor"), ("--profile indor", "indoor")],
)  # fmt: skip
def test_a_mistyped_word_gets_a_suggestion(words: str, similar: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert usage_error(words.split(), capsys).endswith(f"did you mean '{similar}'?")


def test_a_word_like_no_other_gets_the_profiles(capsys: pytest.CaptureFixture[str]) -> None:
    line = usage_error(["xyzzy"], capsys)
    assert "did you mean" not in line and line.endswith("profiles: competition, indoor, outdoor, warehouse")


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("--headless --duration x", "argument --duration: 'x' is not a number"),
        ("--headless --duration 1e999", "argument --duration: must be positive and finite, not 1e999"),
        ("--headless --duration nan", "argument --duration: must be positive and finite, not nan"),
        ("--headless --seed 1.5", "argument --seed: '1.5' is not an integer"),
        ("serve --port 65536", "argument --port: must be from 0 to 65535, not 65536"),
        ("serve --port -1", "argument --port: must be from 0 to 65535, not -1"),
        ("serve --sessions 0", "argument --sessions: must be from 1 to 100, not 0"),
        ("graph --wait nan", "argument --wait: must not be negative or infinite: nan"),
        ("graph --measure 0", "argument --measure: must be positive and finite, not 0"),
        ("check --wait -1 steps.txt", "argument --wait: must not be negative or infinite: -1"),
        ("doctor --seconds inf", "argument --seconds: must not be negative or infinite: inf"),
        ("tune max_speed --jobs -1", "argument --jobs: must be from 0 to 1000000, not -1"),
        ("bag record -a --duration nan", "argument --duration: must be positive and finite, not nan"),
        ("missing.yaml", "error: there is no file missing.yaml"),
    ],
)
def test_impossible_numbers_and_files_are_named(words: str, message: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert usage_error(words.split(), capsys).endswith(message)


def test_help_of_up_explains_up(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["up", "--help"]) == 0
    out = capsys.readouterr().out
    assert out.startswith("usage: bot-console up ")
    assert "in the background" in out and "--serve" in out and "--pane" not in out


def test_file_that_cannot_be_read_is_a_finding_of_lint(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    wrong, latin = tmp_path / "wrong.py", tmp_path / "latin.py"
    wrong.write_text("x = 1\ndef (:\n")
    latin.write_bytes(b"x = '\xe9'\n")
    assert main(["lint", str(tmp_path)]) == 1
    out, err = capsys.readouterr()
    first, second = out.splitlines()
    assert first.startswith(f"{latin}: not UTF-8: the file cannot be read; ")
    assert second.startswith(f"{wrong}:2: invalid syntax: the file is not valid Python; ")
    assert "nothing found" not in err


def test_connect_without_a_command_names_the_one_that_opens_a_console(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--connect", "tcp/robot:7447"]) == 2
    assert capsys.readouterr().err.endswith("write `bot-console attach --connect tcp/robot:7447`\n")


@pytest.mark.parametrize(
    ("words", "written"),
    [
        ("node list --connect tcp/robot:7447", "BOT_CONSOLE_CONNECT=tcp/robot:7447 bot-console node list"),
        ("topic hz --connect=tcp/robot:7447 /scan", "BOT_CONSOLE_CONNECT=tcp/robot:7447 bot-console topic hz /scan"),
        ("param set --connect /a b 1", "BOT_CONSOLE_CONNECT=tcp/robot:7447 bot-console param set /a b 1"),
        ("ros2 param get /a b --connect", "BOT_CONSOLE_CONNECT=tcp/robot:7447 bot-console ros2 param get /a b"),
        ("status --connect tcp/robot:7447", "BOT_CONSOLE_CONNECT=tcp/robot:7447 bot-console status"),
    ],
)
def test_a_command_that_takes_no_connect_says_how_to_reach_the_robot(
    words: str, written: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(words.split()) == 2
    assert capsys.readouterr().err.endswith(f"only attach and doctor take --connect; write `{written}`\n")
